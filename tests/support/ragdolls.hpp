#pragma once

#include <memory>

#include "scene/asset/ragdoll_asset.hpp"
#include "support/catch.hpp"
#include "support/rigs.hpp"

namespace lutka::test {

/// makeBiped() mapped, fitted and bound.
[[nodiscard]] inline std::unique_ptr<scene::RagdollAsset> bipedRagdoll() {
    auto asset = scene::makeRagdoll(makeBiped());
    REQUIRE(asset);
    return std::move(asset).value();
}

}  // namespace lutka::test
