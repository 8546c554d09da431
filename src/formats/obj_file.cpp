// An OBJ file's polygons and OpenSubdiv's tags, as they stand in the file.
#include "formats/obj_file.h"

#include "formats/obj_lines.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace tessera {

namespace {

using Words = std::span<const std::string_view>;

// Numbers names as they are met.
class Numbered {
public:
    explicit Numbered(std::vector<std::string>& names) : names_(names) {
        for (std::size_t i = 0; i < names.size(); ++i) numbers_.emplace(names[i], static_cast<std::uint32_t>(i));
    }
    std::uint32_t number(const std::string& name) {
        const auto [found, isNew] = numbers_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
        if (isNew) names_.push_back(name);
        return found->second;
    }

private:
    std::vector<std::string>& names_;
    std::unordered_map<std::string, std::uint32_t> numbers_;
};

// A tag's lists: `t NAME INTS/FLOATS/STRINGS` and as many words.
struct Tag {
    std::string_view name;
    std::vector<std::uint32_t> ints;
    std::vector<float> floats;
};

class Parser {
public:
    Parser(std::string_view text, const MeshNotes& notes) : lines_(text), notes_(notes) {}

    ObjFile parse() {
        while (lines_.next()) readLine(lines_.words()[0], Words(lines_.words()).subspan(1));
        checkLater();
        return std::move(file_);
    }

private:
    // What a line names may come after it: it is checked when all is read.
    struct Later {
        std::size_t line = 0;
        std::uint64_t highest = 0;  // number, from 0
        enum class Of { vertices, texturePoints, faces } of = Of::vertices;
    };

    [[noreturn]] void fail(const std::string& what, std::size_t line) const { notes_.fail("line " + std::to_string(line) + ": " + what); }
    [[noreturn]] void fail(const std::string& what) const { fail(what, lines_.number()); }

    void readLine(std::string_view keyword, Words words) {
        if (keyword == "v") {
            const auto [x, y, z] = numbers<3>(words, "a vertex has three coordinates");
            file_.points.emplace_back(x, y, z);
        } else if (keyword == "vt") {
            // One-dimensional ones exist.
            const float u = numbers<1>(words, "a texture point has a coordinate")[0];
            file_.texturePoints.emplace_back(u, words.size() > 1 ? number(words[1]) : 0.0F);
        } else if (keyword == "f" || keyword == "fo") {
            readFace(words);
        } else if (keyword == "o") {
            object_ = objects_.number(lines_.rest());
        } else if (keyword == "usemtl") {
            material_ = materials_.number(lines_.rest());
        } else if (keyword == "mtllib") {
            static_cast<void>(materialFiles_.number(lines_.rest()));
        } else if (keyword == "t") {
            readTag(words);
        }
    }

    float number(std::string_view word) const {
        const std::optional<double> value = objNumber(word);
        if (!value.has_value()) fail(quotedName(word) + " is no number; repair the line");
        return static_cast<float>(*value);
    }

    template <std::size_t count>
    std::array<float, count> numbers(Words words, std::string_view rule) const {
        if (words.size() < count) fail(std::string(rule) + ", and here are " + std::to_string(words.size()) + "; complete the line");
        std::array<float, count> values{};
        for (std::size_t i = 0; i < count; ++i) values[i] = number(words[i]);
        return values;
    }

    // From 1, or from -1 back from the latest; from 0 after this.
    std::uint32_t index(std::string_view word, std::size_t soFar) const {
        const std::optional<long long> value = objInteger(word);
        if (!value.has_value() || *value == 0) fail(quotedName(word) + " is no number of a corner, which count from 1; repair the line");
        const long long number = *value > 0 ? *value - 1 : static_cast<long long>(soFar) + *value;
        if (number < 0) fail("corner " + quotedName(word) + " lies before the first of " + std::to_string(soFar) + "; repair the line");
        if (number >= ObjFile::kNone) fail("corner " + quotedName(word) + " does not exist; repair the line");
        return static_cast<std::uint32_t>(number);
    }

    // "7", "7/3", "7//2", "7/3/2"; the normal is not looked at.
    void readCorner(std::string_view word) {
        const std::size_t slash = word.find('/');
        file_.faceVertices.push_back(index(word.substr(0, slash), file_.points.size()));
        std::string_view texture = slash == std::string_view::npos ? std::string_view{} : word.substr(slash + 1);
        texture = texture.substr(0, texture.find('/'));
        file_.faceTexturePoints.push_back(texture.empty() ? ObjFile::kNone : index(texture, file_.texturePoints.size()));
    }

    void readFace(Words words) {
        if (words.empty()) fail("a face without corners; remove the line");
        const std::size_t first = file_.faceVertices.size();
        for (const std::string_view word : words) readCorner(word);
        file_.faces.push_back({static_cast<std::uint32_t>(words.size()), object_, material_});
        std::uint64_t vertex = 0, texture = 0;
        for (std::size_t k = first; k < file_.faceVertices.size(); ++k) {
            vertex = std::max<std::uint64_t>(vertex, file_.faceVertices[k]);
            if (file_.faceTexturePoints[k] != ObjFile::kNone) texture = std::max<std::uint64_t>(texture, file_.faceTexturePoints[k] + 1ULL);
        }
        if (vertex >= file_.points.size()) checkLater(vertex, Later::Of::vertices);
        if (texture > file_.texturePoints.size()) checkLater(texture - 1, Later::Of::texturePoints);
    }

    Tag splitTag(Words words) const {
        if (words.size() < 2) fail("a tag is 't NAME INTS/FLOATS/STRINGS' and its values; complete the line");
        std::array<std::size_t, 3> counts{};
        std::string_view sizes = words[1];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t slash = i < 2 ? sizes.find('/') : sizes.size();
            const std::optional<long long> count = slash == std::string_view::npos ? std::nullopt : objInteger(sizes.substr(0, slash));
            if (!count.has_value() || *count < 0) fail(quotedName(words[1]) + " is no INTS/FLOATS/STRINGS, 2/1/0 say; repair the line");
            counts[i] = static_cast<std::size_t>(*count);
            sizes.remove_prefix(std::min(slash + 1, sizes.size()));
        }
        const Words values = words.subspan(2);
        // One by one: sums of them may be beyond 64 bits.
        if (counts[0] > values.size() || counts[1] > values.size() || counts[2] > values.size() ||
            counts[0] + counts[1] + counts[2] != values.size()) {
            fail("tag " + quotedName(words[0]) + " announces " + std::string(words[1]).substr(0, 40) + " values and has " +
                 std::to_string(values.size()) + "; repair the line");
        }
        Tag tag{words[0], {}, {}};
        for (const std::string_view word : values.first(counts[0])) tag.ints.push_back(tagNumber(word));
        for (const std::string_view word : values.subspan(counts[0], counts[1])) tag.floats.push_back(number(word));
        return tag;
    }

    std::uint32_t tagNumber(std::string_view word) const {
        const std::optional<long long> value = objInteger(word);
        if (!value.has_value() || *value < 0 || *value >= ObjFile::kNone) {
            fail(quotedName(word) + " is no number in a tag, which count from 0; repair the line");
        }
        return static_cast<std::uint32_t>(*value);
    }

    // The sharpness of the tag's item `i` of `count`: each has its own, or all the same.
    float sharpness(const Tag& tag, std::size_t i, std::size_t count) const {
        if (tag.floats.size() != 1 && tag.floats.size() != count) {
            fail("tag " + quotedName(tag.name) + " has " + std::to_string(tag.floats.size()) + " sharpnesses for " + std::to_string(count) +
                 "; give one, or one each");
        }
        const float value = tag.floats.size() == 1 ? tag.floats[0] : tag.floats[i];
        if (!(value >= 0.0F)) fail("sharpness " + numberText(value) + " is outside its range; give 0 to 10");
        return value;
    }

    void readTag(Words words) {
        const Tag tag = splitTag(words);
        file_.tagged = true;
        if (tag.name == "crease") {
            if (tag.ints.size() % 2 != 0) fail("a crease tag has two vertices an edge, and here are " + std::to_string(tag.ints.size()));
            const std::size_t edges = tag.ints.size() / 2;
            for (std::size_t i = 0; i < edges; ++i) {
                file_.creases.push_back({tag.ints[2 * i], tag.ints[2 * i + 1], sharpness(tag, i, edges)});
            }
            checkLater(tag, Later::Of::vertices);
        } else if (tag.name == "corner") {
            for (std::size_t i = 0; i < tag.ints.size(); ++i) {
                file_.corners.push_back({tag.ints[i], sharpness(tag, i, tag.ints.size())});
            }
            checkLater(tag, Later::Of::vertices);
        } else if (tag.name == "hole") {
            file_.holes.insert(file_.holes.end(), tag.ints.begin(), tag.ints.end());
            checkLater(tag, Later::Of::faces);
        } else if (tag.name == "interpolateboundary") {
            readBoundary(tag);
        } else if (unknownTags_.size() < 50 && unknownTags_.insert(std::string(tag.name)).second) {
            notes_.warn("line " + std::to_string(lines_.number()) + ": tag " + quotedName(tag.name) + " is none of those that are read");
        }
    }

    void readBoundary(const Tag& tag) {
        if (tag.ints.size() != 1 || tag.ints[0] > 2) fail("interpolateboundary is 0, 1 or 2; repair the line");
        file_.boundary = static_cast<BoundaryRule>(tag.ints[0]);
    }

    void checkLater(const Tag& tag, Later::Of of) {
        if (!tag.ints.empty()) checkLater(*std::max_element(tag.ints.begin(), tag.ints.end()), of);
    }
    void checkLater(std::uint64_t highest, Later::Of of) { later_.push_back({lines_.number(), highest, of}); }

    void checkLater() const {
        for (const Later& one : later_) {
            const bool vertices = one.of == Later::Of::vertices, faces = one.of == Later::Of::faces;
            const std::size_t count = vertices ? file_.points.size() : (faces ? file_.faces.size() : file_.texturePoints.size());
            if (one.highest < count) continue;
            const std::string what = vertices ? "vertex" : (faces ? "face" : "texture point");
            fail(what + " number " + std::to_string(one.highest) + ", counted from 0, is none of " + std::to_string(count) +
                     "; repair the line",
                 one.line);
        }
    }

    ObjLines lines_;
    const MeshNotes& notes_;
    ObjFile file_;
    Numbered objects_{file_.objects}, materials_{file_.materials}, materialFiles_{file_.materialFiles};
    std::uint32_t object_ = 0;
    std::uint32_t material_ = ObjFile::kNone;
    std::vector<Later> later_;
    std::unordered_set<std::string> unknownTags_;
};

}  // namespace

bool hasObjTags(std::string_view text) {
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.starts_with("t ") || line.starts_with("t\t")) return true;
    }
    return false;
}

ObjFile parseObj(std::string_view text, const MeshNotes& notes) { return Parser(text, notes).parse(); }

}  // namespace tessera
