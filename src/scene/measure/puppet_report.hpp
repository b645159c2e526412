#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "physics/world/world_view.hpp"
#include "scene/puppet/puppet_cast.hpp"

namespace lutka::scene {

/// "rms", "max", "worst" and, of each joint, "joints"; degrees.
[[nodiscard]] nlohmann::ordered_json trackingJson(const PuppetFigures& figures);
/// Null below 0, which stands for never.
[[nodiscard]] nlohmann::ordered_json secondsJson(float seconds);
/// The figures of puppets in their world as reports print them; keys as in docs/cli.md.
[[nodiscard]] nlohmann::ordered_json puppetJson(const PuppetCast& cast, const physics::WorldView& world);
[[nodiscard]] std::string puppetText(const PuppetCast& cast, const physics::WorldView& world);

}  // namespace lutka::scene
