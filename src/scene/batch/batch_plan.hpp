#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "physics/fit/fit_options.hpp"
#include "physics/world/world_settings.hpp"

namespace lutka::scene {

/// A character of a batch. Names are as the list has them; files are where they lie.
struct BatchModel {
    std::string name;
    std::filesystem::path file;
    std::string profileName;                       ///< Empty: a fitted one.
    std::optional<std::filesystem::path> profile;  ///< Likewise unset.
    physics::RigKind rig = physics::RigKind::humanoid;
};

struct BatchScene {
    std::string name;                           ///< Of a named scene, or the file as the list has it.
    std::optional<std::filesystem::path> file;  ///< Set: a scene file, which has its own start and takes no seed.
};

/// One fall of a batch.
struct BatchRow {
    std::uint32_t model = 0;  ///< Index into BatchPlan::models.
    std::uint32_t scene = 0;
    std::uint64_t seed = 0;
};

/// What `lutka batch` is given: models × scenes × seeds, all alike (docs/howto.md).
struct BatchPlan {
    static constexpr int kVersion = 1;
    static constexpr std::size_t kMostRows = 1'000'000;

    std::vector<BatchModel> models;
    std::vector<BatchScene> scenes;
    std::vector<std::uint64_t> seeds{0};
    int count = 1;                 ///< Dolls in a named scene.
    std::optional<float> seconds;  ///< Unset: what the scene needs.
    std::optional<physics::SolverKind> solver;
    bool bake = false;           ///< Writes each first doll's fall as an animation, too.
    std::vector<BatchRow> rows;  ///< Models, within them scenes, within them seeds.
};

/// Reads a list strictly. Paths in it start at `folder`. Fails with ErrorCode::input and all problems at once, each
/// with the JSON pointer of its place; `source` names the document.
[[nodiscard]] Result<BatchPlan> batchFromJson(std::string_view text, std::string_view source,
                                              const std::filesystem::path& folder = {});
[[nodiscard]] Result<BatchPlan> loadBatch(const std::filesystem::path& file);

/// A part of the rows that a process of its own takes: every `of`-th one.
struct BatchShard {
    int number = 1;  ///< In [1, of].
    int of = 1;
    [[nodiscard]] bool has(std::size_t row) const {
        return row % static_cast<std::size_t>(of) == static_cast<std::size_t>(number - 1);
    }
};
/// "3/8". Fails with ErrorCode::usage for anything else; at most 100,000 parts.
[[nodiscard]] Result<BatchShard> parseBatchShard(std::string_view text);

}  // namespace lutka::scene
