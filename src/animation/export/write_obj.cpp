#include "animation/export/write_obj.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/assert.hpp"
#include "core/files.hpp"

namespace lutka::animation {
namespace {

// A name ends at the line's end.
std::string oneLine(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c < 0x20; }, '_');
    return name.empty() ? "mesh" : name;
}

void appendMesh(const SkinnedMesh& mesh, std::span<const SkinMatrix> palette, const RigidTransform& worldFromModel,
                std::size_t& firstVertex, std::size_t& firstUv, fmt::memory_buffer& out) {
    std::vector<vec3> positions(mesh.positions.size());
    std::vector<vec3> normals(mesh.positions.size());
    skinVertices(mesh, palette, positions, normals);
    const auto sink = std::back_inserter(out);
    fmt::format_to(sink, "o {}\n", oneLine(mesh.name));
    for (const vec3& position : positions) {
        const vec3 p = worldFromModel * position;
        fmt::format_to(sink, "v {} {} {}\n", p.x, p.y, p.z);
    }
    // OBJ's pictures start at the lower left.
    for (const vec2& uv : mesh.uvs)
        fmt::format_to(sink, "vt {} {}\n", uv.x, 1.0F - uv.y);
    for (const vec3& normal : normals) {
        const vec3 n = worldFromModel.rotation * normal;
        fmt::format_to(sink, "vn {} {} {}\n", n.x, n.y, n.z);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::size_t v = firstVertex + mesh.indices[i];
        const char* const before = i % 3 == 0 ? "f " : " ";
        const char* const after = i % 3 == 2 ? "\n" : "";
        if (mesh.uvs.empty()) {
            fmt::format_to(sink, "{}{}//{}{}", before, v, v, after);
        } else {
            fmt::format_to(sink, "{}{}/{}/{}{}", before, v, firstUv + mesh.indices[i], v, after);
        }
    }
    firstVertex += positions.size();
    firstUv += mesh.uvs.size();
}

}  // namespace

Result<void> writeObj(const std::filesystem::path& file, const Character& character,
                      std::span<const SkinMatrix> palette, const RigidTransform& worldFromModel) {
    LUTKA_ASSERT(palette.size() == character.skeleton.parents.size());
    fmt::memory_buffer out;
    fmt::format_to(std::back_inserter(out), "# Lutka: {}, metres, Y up\n", oneLine(character.name));
    std::size_t firstVertex = 1;
    std::size_t firstUv = 1;
    for (const SkinnedMesh& mesh : character.meshes)
        appendMesh(mesh, palette, worldFromModel, firstVertex, firstUv, out);
    return writeFileAtomically(file, std::string_view(out.data(), out.size()));
}

}  // namespace lutka::animation
