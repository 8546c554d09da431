// The JSON of a GLB file, put together as text: bounds of positions have one length, so that they can be written over at the end.
#include "formats/glb_json.h"

#include <charconv>
#include <string_view>

#include "scene/text.h"

namespace tessera {
namespace {

constexpr int kFloat = 5126, kUint = 5125, kVertices = 34962, kIndices = 34963;

std::string quoted(const std::string& name) {
    constexpr std::string_view digits = "0123456789abcdef";
    const bool wellFormed = isUtf8(name);
    std::string text = "\"";
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20) {
            text += std::string("\\u00") + digits[byte >> 4U] + digits[byte & 15U];
        } else if (byte >= 0x80 && !wellFormed) {
            text += '?';
        } else {
            if (c == '"' || c == '\\') text += '\\';
            text += c;
        }
    }
    return text + '"';
}

// With blanks before it, all numbers are of one length.
std::string fixedWidth(float x) {
    constexpr std::size_t width = 16;
    std::array<char, 32> digits{};
    char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), x, std::chars_format::scientific).ptr;
    const std::string text(digits.data(), end);
    return std::string(width - text.size(), ' ') + text;
}

std::string vectorText(const std::array<float, 3>& v) {
    return "[" + fixedWidth(v[0]) + "," + fixedWidth(v[1]) + "," + fixedWidth(v[2]) + "]";
}

std::string field(std::string_view name, std::uint64_t value) { return "\"" + std::string(name) + "\":" + std::to_string(value); }

// A list's items with commas between them, and what they are called by index.
class List {
public:
    std::uint64_t add(const std::string& item) {
        text_ += (count_ == 0 ? "" : ",") + item;
        return count_++;
    }
    // Of an object's fields; nothing where the list is empty, which the format does not allow.
    [[nodiscard]] std::string as(const std::string& name) const { return count_ == 0 ? "" : ",\"" + name + "\":[" + text_ + "]"; }

private:
    std::string text_;
    std::uint64_t count_ = 0;
};

struct Lists {
    List views, accessors, meshes, nodes, roots;
};

std::string accessorText(std::uint64_t view, std::uint64_t offset, int component, std::uint64_t count, std::string_view type) {
    return field("bufferView", view) + "," + field("byteOffset", offset) + "," +
           field("componentType", static_cast<std::uint64_t>(component)) + "," + field("count", count) + R"(,"type":")" +
           std::string(type) + "\"";
}

std::uint64_t addView(Lists& lists, std::uint64_t offset, std::uint64_t bytes, std::uint64_t stride, int target) {
    std::string text = "{\"buffer\":0," + field("byteOffset", offset) + "," + field("byteLength", bytes);
    if (stride > 0) text += "," + field("byteStride", stride);
    return lists.views.add(text + "," + field("target", static_cast<std::uint64_t>(target)) + "}");
}

std::uint64_t addMesh(Lists& lists, const std::string& name, const GlbMesh& mesh, bool positionsOnly) {
    const std::uint64_t stride = glbVertexBytes(positionsOnly);
    const std::uint64_t vertices = addView(lists, mesh.verticesAt, mesh.vertices * stride, stride, kVertices);
    const std::uint64_t indices = addView(lists, mesh.indicesAt, mesh.triangles * 12, 0, kIndices);
    const auto accessor = [&](std::uint64_t offset, std::string_view type, const std::string& more = "") {
        return lists.accessors.add("{" + accessorText(vertices, offset, kFloat, mesh.vertices, type) + more + "}");
    };
    const std::string bounds = ",\"min\":" + vectorText(mesh.lower) + ",\"max\":" + vectorText(mesh.upper);
    std::string attributes = field("POSITION", accessor(0, "VEC3", bounds));
    if (!positionsOnly) {
        attributes += "," + field("NORMAL", accessor(12, "VEC3"));
        attributes += "," + field("TEXCOORD_0", accessor(24, "VEC2"));
        attributes += "," + field("_PATCH_ID", accessor(32, "SCALAR"));
    }
    const std::uint64_t triangles = lists.accessors.add("{" + accessorText(indices, 0, kUint, mesh.triangles * 3, "SCALAR") + "}");
    return lists.meshes.add("{\"name\":" + quoted(name) + R"(,"primitives":[{"attributes":{)" + attributes + "}," +
                            field("indices", triangles) + "}]}");
}

}  // namespace

std::string glbJson(std::span<const GlbNode> nodes, std::uint64_t binaryBytes, bool positionsOnly) {
    Lists lists;
    for (const GlbNode& node : nodes) {
        std::string text = "{\"name\":" + quoted(node.name);
        if (node.mesh.triangles > 0) text += "," + field("mesh", addMesh(lists, node.name, node.mesh, positionsOnly));
        lists.roots.add(std::to_string(lists.nodes.add(text + "}")));
    }
    const std::string roots = lists.roots.as("nodes");
    std::string json = R"({"asset":{"version":"2.0","generator":"Tessera"},"scene":0,"scenes":[{)";
    json += (roots.empty() ? "" : roots.substr(1)) + "}]";
    json += lists.nodes.as("nodes") + lists.meshes.as("meshes") + lists.accessors.as("accessors") + lists.views.as("bufferViews");
    if (binaryBytes > 0) json += ",\"buffers\":[{" + field("byteLength", binaryBytes) + "}]";
    json += "}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return json;
}

}  // namespace tessera
