#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "physics/profile/profile.hpp"

namespace lutka::physics {

/// The profile as its JSON document (docs/profile.md): versioned, SI units, keys in a fixed order, diffable.
[[nodiscard]] std::string profileToJson(const RagdollProfile& profile);

/// Strict reading: unknown keys, wrong types, non-finite or out-of-range numbers, unknown roles, two bodies on one
/// joint, cycles and missing parents are listed all at once, each with its JSON pointer and what was expected. `source`
/// names the document in messages. Older versions are upgraded.
[[nodiscard]] Result<RagdollProfile> profileFromJson(std::string_view json, std::string_view source);

[[nodiscard]] Result<void> saveProfile(const std::filesystem::path& file, const RagdollProfile& profile);
[[nodiscard]] Result<RagdollProfile> loadProfile(const std::filesystem::path& file);

}  // namespace lutka::physics
