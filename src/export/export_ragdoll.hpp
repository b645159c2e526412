#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "animation/character.hpp"
#include "core/result.hpp"
#include "physics/profile/profile.hpp"
#include "physics/rig/rig.hpp"

/// A ragdoll in the file formats and conventions of other engines: see docs/export.md.
namespace lutka::exporting {

/// What is exported. The rig is that of the profile on the character's skeleton.
struct ExportSource {
    const animation::Character& character;
    const physics::RagdollProfile& profile;
    const physics::Rig& rig;
};

enum class ExportFormat { mjcf, glb, gltf, godot4, godot3, blender, urdf, bullet, usd };

/// A format as users meet it.
struct ExportFormatInfo {
    ExportFormat format;
    std::string_view name;     ///< On the command line: "mjcf".
    std::string_view ending;   ///< Of its files, with the dot: ".xml".
    std::string_view summary;  ///< A few words for the help.
};

/// Every format there is. Where two share an ending, the first one is meant by it.
[[nodiscard]] std::span<const ExportFormatInfo> exportFormats();
[[nodiscard]] std::optional<ExportFormat> exportFormatNamed(std::string_view name);
/// By the ending of the file's name, in any case of letters.
[[nodiscard]] std::optional<ExportFormat> exportFormatOf(const std::filesystem::path& file);

/// A document in the target's format, and what it does not hold.
struct Exported {
    std::string bytes;
    std::vector<std::string> warnings;  ///< What was left out or approximated, and by how much; a sentence each.
};

/// Never fails for a valid profile and its rig, but for ErrorCode::internal where a writer beneath fails.
[[nodiscard]] Result<Exported> exportRagdoll(ExportFormat format, const ExportSource& source);

}  // namespace lutka::exporting
