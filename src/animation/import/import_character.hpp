#pragma once

#include <filesystem>
#include <optional>

#include "animation/character.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// The direction of the file's data that points up.
enum class UpAxis { positiveX, negativeX, positiveY, negativeY, positiveZ, negativeZ };

struct ImportOptions {
    /// Metres a file unit, > 0 (else ErrorCode::usage); unset: from the file's metadata, or from the figure's height
    /// where that is missing or absurd.
    std::optional<float> metresPerFileUnit;
    std::optional<UpAxis> up;  ///< Unset: from the file's metadata, or from the figure where that is missing.
    bool loadTextures = true;  ///< False skips decoding pictures (mapping and physics don't need them).
};

/// Loads any rigged model that Assimp reads and settles it in model space: metres, Y up, rigid joint frames with all
/// scales baked, vertices in the bind pose, at most four influences with sum 1. Which way it faces is left as it is.
/// Fails with ErrorCode::input (file, reason, mend); never throws.
[[nodiscard]] Result<Character> importCharacter(const std::filesystem::path& file, const ImportOptions& options = {});

}  // namespace lutka::animation
