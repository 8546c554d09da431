// glTF's extension TESSERA_subdivision_surface: read from the file's JSON, of which Assimp hands on none.
#include "formats/gltf_subdivision.h"

#include "formats/obj_lines.h"
#include "scene/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace tessera {

namespace {

using Json = nlohmann::json;

constexpr std::string_view kExtension = "TESSERA_subdivision_surface";
constexpr std::string_view kNgons = "FB_ngon_encoding";
constexpr std::string_view kNumbered = "TESSERA_mesh_";
// Written again with recursion: a file of brackets must not fill the stack.
constexpr int kDeepest = 64;
constexpr std::size_t kGlbHead = 12, kChunkHead = 8;
constexpr std::uint32_t kGlbMagic = 0x46546C67, kJsonChunk = 0x4E4F534A;

std::uint32_t word(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
    return value;
}

void putWord(std::string& bytes, std::size_t value) {
    for (std::size_t k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xFFU);
}

bool isGlb(std::string_view bytes) { return bytes.size() >= kGlbHead + kChunkHead && word(bytes, 0) == kGlbMagic; }

// The JSON's place in the file: offset and length. Length 0 where there is none.
std::pair<std::size_t, std::size_t> jsonPlace(std::string_view bytes) {
    if (!isGlb(bytes)) return {0, bytes.size()};
    const std::size_t begin = kGlbHead + kChunkHead, length = word(bytes, kGlbHead);
    if (word(bytes, kGlbHead + 4) != kJsonChunk || length > bytes.size() - begin) return {begin, 0};
    return {begin, length};
}

// The file with other JSON in its place.
std::string withJson(std::string_view bytes, std::string json) {
    if (!isGlb(bytes)) return json;
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto [begin, length] = jsonPlace(bytes);
    const std::string_view after = bytes.substr(begin + length);
    std::string file(bytes.substr(0, 8));
    putWord(file, begin + json.size() + after.size());
    putWord(file, json.size());
    putWord(file, kJsonChunk);
    return file + json + std::string(after);
}

// A member of an object; null where either is none.
const Json& member(const Json& object, const std::string& name) {
    static const Json none;
    if (!object.is_object()) return none;
    const auto found = object.find(name);
    return found == object.end() ? none : *found;
}

const Json& item(const Json& list, std::uint64_t index) {
    static const Json none;
    return list.is_array() && index < list.size() ? list[static_cast<std::size_t>(index)] : none;
}

class Reader {
public:
    Reader(const Json& source, std::string where, std::uint64_t vertices, const MeshNotes& notes)
        : source_(source), where_(std::move(where)), vertices_(vertices), notes_(notes) {}

    GltfCage read() {
        if (!source_.is_object()) fail("", "is no object");
        Cage cage;
        cage.scheme = named("scheme", {{"catmull-clark", 0}, {"loop", 1}, {"bilinear", 2}}, cage.scheme);
        cage.boundary = named("boundary", {{"none", 0}, {"edge-and-corner", 1}, {"edge-only", 2}}, cage.boundary);
        forEach("creases", [&](const Json& one) {
            if (!one.is_array() || one.size() != 3) fail("creases", "has an item that is no [a, b, sharpness]");
            cage.creases.push_back({vertex("creases", one[0]), vertex("creases", one[1]), sharpness("creases", one[2])});
        });
        forEach("corners", [&](const Json& one) {
            if (!one.is_array() || one.size() != 2) fail("corners", "has an item that is no [vertex, sharpness]");
            cage.corners.push_back({vertex("corners", one[0]), sharpness("corners", one[1])});
        });
        readFaces(cage);
        forEach("holes", [&](const Json& one) { cage.holes.push_back(number("holes", one, 0xFFFFFFFFU)); });
        const std::uint32_t highest = cage.holes.empty() ? 0 : *std::max_element(cage.holes.begin(), cage.holes.end());
        return {std::move(cage), vertices_, highest, true, false};
    }

private:
    [[noreturn]] void fail(const std::string& name, const std::string& what) const {
        notes_.fail(where_ + ", " + std::string(kExtension) + (name.empty() ? "" : "." + name) + ": " + what + "; repair it");
    }

    // The value of an enumeration whose numbers are given with the names.
    template <typename Value>
    [[nodiscard]] Value named(const std::string& name, const std::vector<std::pair<std::string, int>>& known, Value usual) const {
        const Json& value = member(source_, name);
        if (value.is_null()) return usual;
        std::string names;
        for (const auto& [one, number] : known) {
            if (value == one) return static_cast<Value>(number);
            names += (names.empty() ? "" : ", ") + one;
        }
        fail(name, "is none of " + names);
    }

    void forEach(const std::string& name, const std::function<void(const Json&)>& read) const {
        const Json& list = member(source_, name);
        if (list.is_null()) return;
        if (!list.is_array()) fail(name, "is no array");
        for (const Json& one : list) read(one);
    }

    [[nodiscard]] std::uint32_t number(const std::string& name, const Json& value, std::uint64_t most) const {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
            fail(name, "has a number that is not whole or not within 0 to " + std::to_string(most));
        }
        return static_cast<std::uint32_t>(value.get<std::uint64_t>());
    }

    [[nodiscard]] std::uint32_t vertex(const std::string& name, const Json& value) const {
        if (vertices_ == 0) fail(name, "names vertices, and the primitive's POSITION has none");
        return number(name, value, vertices_ - 1);
    }

    [[nodiscard]] float sharpness(const std::string& name, const Json& value) const {
        if (!value.is_number() || !(value.get<double>() >= 0.0)) fail(name, "has a sharpness that is no number of 0 or more");
        return static_cast<float>(std::min(value.get<double>(), 1e6));
    }

    // Together or not at all.
    void readFaces(Cage& cage) const {
        std::uint64_t corners = 0;
        forEach("faceSizes", [&](const Json& one) {
            cage.faceSizes.push_back(number("faceSizes", one, 0xFFFFFFFFU));
            corners += cage.faceSizes.back();
        });
        forEach("faceVertices", [&](const Json& one) { cage.faceVertices.push_back(vertex("faceVertices", one)); });
        if (corners != cage.faceVertices.size()) {
            fail("faceSizes",
                 "sums up to " + std::to_string(corners) + ", and faceVertices are " + std::to_string(cage.faceVertices.size()));
        }
    }

    const Json& source_;
    std::string where_;
    std::uint64_t vertices_;
    const MeshNotes& notes_;
};

Json parseJson(std::string_view text, const MeshNotes& notes) {
    bool deep = false;
    // Discards what is below the depth, so that none of it is kept.
    const Json::parser_callback_t callback = [&deep](int depth, Json::parse_event_t /*event*/, Json& /*parsed*/) {
        deep = deep || depth > kDeepest;
        return depth <= kDeepest;
    };
    try {
        Json json = Json::parse(text.begin(), text.end(), callback);
        if (deep) notes.fail("its JSON is nested more than " + std::to_string(kDeepest) + " deep; make it flatter");
        return json;
    } catch (const Json::exception& exception) {
        notes.fail("its JSON cannot be read: " + oneLine(exception.what()) + "; repair it");
    }
}

std::uint64_t positionCount(const Json& file, const Json& primitive) {
    const Json& accessor = member(member(primitive, "attributes"), "POSITION");
    if (!accessor.is_number_unsigned()) return 0;
    const Json& count = member(item(member(file, "accessors"), accessor.get<std::uint64_t>()), "count");
    return count.is_number_unsigned() ? std::min<std::uint64_t>(count.get<std::uint64_t>(), 0xFFFFFFFFU) : 0;
}

}  // namespace

GltfSubdivision::GltfSubdivision(std::string_view bytes, const MeshNotes& notes) {
    const auto [begin, length] = jsonPlace(bytes);
    const std::string_view text = bytes.substr(begin, length);
    if (text.find(kExtension) == std::string_view::npos && text.find(kNgons) == std::string_view::npos) return;
    Json file = parseJson(text, notes);
    const auto meshes = file.is_object() ? file.find("meshes") : file.end();
    if (!file.is_object() || meshes == file.end() || !meshes->is_array()) return;
    for (std::size_t m = 0; m < meshes->size(); ++m) {
        Json& mesh = (*meshes)[m];
        if (!mesh.is_object()) continue;
        const Json& primitives = member(mesh, "primitives");
        for (std::size_t p = 0; primitives.is_array() && p < primitives.size(); ++p) {
            const Json& extensions = member(primitives[p], "extensions");
            const Json& extension = member(extensions, std::string(kExtension));
            const bool ngons = !member(extensions, std::string(kNgons)).is_null();
            if (extension.is_null() && !ngons) continue;
            const std::uint64_t vertices = positionCount(file, primitives[p]);
            const std::string where = "mesh number " + std::to_string(m) + ", primitive " + std::to_string(p);
            GltfCage cage{{}, vertices, 0, false, false};
            if (!extension.is_null()) cage = Reader(extension, where, vertices, notes).read();
            cage.ngons = ngons;
            cages_.emplace(std::pair(m, p), std::move(cage));
        }
        if (const Json& name = member(mesh, "name"); name.is_string() && !name.get_ref<const std::string&>().empty()) {
            names_.emplace(m, name.get<std::string>());
        }
        mesh["name"] = std::string(kNumbered) + std::to_string(m);
    }
    if (!cages_.empty()) numbered_ = withJson(bytes, file.dump());
}

GltfSubdivision::Primitive GltfSubdivision::find(std::string_view numberedName) const {
    if (!numberedName.starts_with(kNumbered)) return {std::string(numberedName), nullptr};
    const std::string_view tail = numberedName.substr(kNumbered.size());
    const std::size_t dash = tail.find('-');  // where a mesh has several primitives
    const std::optional<long long> mesh = objInteger(tail.substr(0, dash));
    const std::optional<long long> primitive = dash == std::string_view::npos ? 0 : objInteger(tail.substr(dash + 1));
    if (!mesh.has_value() || !primitive.has_value()) return {std::string(numberedName), nullptr};
    const auto name = names_.find(static_cast<std::size_t>(*mesh));
    const auto cage = cages_.find({static_cast<std::size_t>(*mesh), static_cast<std::size_t>(*primitive)});
    const std::string base = name == names_.end() ? "meshes[" + std::to_string(*mesh) + "]" : name->second;
    return {base + (dash == std::string_view::npos ? "" : std::string(tail.substr(dash))), cage == cages_.end() ? nullptr : &cage->second};
}

}  // namespace tessera
