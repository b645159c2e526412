#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scene/description/scenario.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// The characters of a scene: each model and profile loaded once, whatever the number of its dolls.
struct SceneCast {
    std::vector<std::unique_ptr<RagdollAsset>> assets;
    std::vector<int> assetOfRagdoll;  ///< One of scene.all<Ragdoll>().

    [[nodiscard]] std::vector<const RagdollAsset*> pointers() const;
    [[nodiscard]] std::vector<Figure> figures() const;
};

/// Loads the characters of a scene in the order in which they appear. A Ragdoll without a model takes `model`, and one
/// without a profile takes that of `options` when it has `model`; all else of `options` goes for every one. Fails with
/// ErrorCode::usage when a model is missing, or `model` is given and no Ragdoll needs it, else as loadRagdoll() does.
[[nodiscard]] Result<SceneCast> loadCast(const EntityScene& scene, const std::filesystem::path& model,
                                         const LoadOptions& options);

}  // namespace lutka::scene
