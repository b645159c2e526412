#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace lutka::exporting {

/// The two parts of a .glb file (glTF 2.0 specification, "GLB File Format").
struct GlbContainer {
    nlohmann::ordered_json json;
    std::string binary;
};

/// Of a container that we wrote: it must be sound.
[[nodiscard]] GlbContainer unpackGlb(std::string_view bytes);
[[nodiscard]] std::string packGlb(const GlbContainer& container);
/// As one text document: the buffer goes into its URI.
[[nodiscard]] std::string gltfText(const GlbContainer& container);

}  // namespace lutka::exporting
