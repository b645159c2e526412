#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "render/extent.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::scene {
class Simulation;
}

namespace lutka::reporting {

/// A picture with its caption, as plain text.
struct Picture {
    std::string caption;
    std::string png;  ///< The file's bytes.
};

/// Takes pictures of one character at a time, without a display.
class Photographer {
  public:
    /// Fails with ErrorCode::noDisplay where there is no GL context.
    [[nodiscard]] static Result<std::unique_ptr<Photographer>> create();
    ~Photographer();

    /// The doll standing in its bind pose: its skin, its bodies, its limits. Fewer where something fails.
    [[nodiscard]] std::vector<Picture> standing(const scene::RagdollAsset& asset);
    /// The skin alone, as small as for a row of a table; empty where something fails.
    [[nodiscard]] std::string thumbnail(const scene::RagdollAsset& asset);
    /// The simulation's first doll as it is now; empty where something fails. Its asset is that of the last call of
    /// standing().
    [[nodiscard]] std::string moment(scene::Simulation& simulation);

  private:
    struct State;
    explicit Photographer(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

}  // namespace lutka::reporting
