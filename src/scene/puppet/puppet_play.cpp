#include "scene/puppet/puppet_play.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace lutka::scene {
namespace {

std::string bodiesOf(const physics::RagdollProfile& profile) {
    std::string names;
    for (const physics::BodyProfile& body : profile.bodies)
        names += (names.empty() ? "" : ", ") + body.name;
    return "its bodies are " + names;
}

// Whether a part of that name holds the body.
bool holds(std::string_view name, const physics::BodyProfile& body) {
    const auto group = static_cast<std::size_t>(physics::muscleGroupOf(body));
    return name == "all" || name == body.name || name == physics::kMuscleGroupNames[group];
}

// Every part names a body of some doll.
Result<void> checkLed(std::span<const RagdollAsset* const> assets, std::span<const LedPart> led) {
    for (const LedPart& part : led) {
        const bool known = std::any_of(assets.begin(), assets.end(), [&](const RagdollAsset* asset) {
            const auto& bodies = asset->profile.bodies;
            return std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) { return holds(part.name, body); });
        });
        if (known) continue;
        return Error{ErrorCode::usage, fmt::format("no doll has a body or group named '{}'", part.name),
                     assets.front()->character.file.string(),
                     bodiesOf(assets.front()->profile) + "; its groups are trunk, head, arm and leg, or say all"};
    }
    return {};
}

}  // namespace

Result<void> checkBodies(std::span<const RagdollAsset* const> assets, const PuppetPlay& play) {
    for (const PuppetHit& hit : play.hits) {
        const bool known = std::any_of(assets.begin(), assets.end(), [&](const RagdollAsset* asset) {
            return bodyMet(asset->profile, hit.body) >= 0;
        });
        if (known) continue;
        return Error{ErrorCode::usage, fmt::format("no doll has a body {}", hit.body),
                     assets.front()->character.file.string(), bodiesOf(assets.front()->profile)};
    }
    return checkLed(assets, play.led);
}

int bodyMet(const physics::RagdollProfile& profile, std::string_view name) {
    int body = physics::bodyNamed(profile, name);
    if (body >= 0) return body;
    auto role = animation::roleFromName(name);
    if (role) body = physics::bodyOf(profile, *role);
    while (body < 0 && role && animation::isSpine(*role)) {
        role = animation::parentRole(*role);
        body = physics::bodyOf(profile, *role);
    }
    return body;
}

std::vector<bool> keptBodies(const physics::RagdollProfile& profile, std::span<const LedPart> led) {
    std::vector<bool> kept(profile.bodies.size(), false);
    for (std::size_t body = 0; body < kept.size(); ++body)
        for (const LedPart& part : led)
            if (holds(part.name, profile.bodies[body])) kept[body] = part.weight >= 1.0F;
    return kept;
}

physics::PuppetSettings settingsOf(const PuppetPlay& play, const physics::RagdollProfile& profile, int root) {
    physics::PuppetSettings settings = play.puppet;
    if (const auto own = physics::musclesOf(profile, play.gravity); own && play.ownMuscles) {
        settings.muscles = *own;
        settings.muscles.strength *= play.puppet.muscles.strength;
    }
    if (play.ownMuscles && settings.muscles.bodies.empty())
        for (const physics::BodyProfile& body : profile.bodies)
            settings.muscles.bodies.push_back(body.muscle);
    if (play.carriesGravity) settings.muscles.carriedGravity = play.gravity;
    settings.gravity = std::max(-play.gravity.y, 0.1F);
    settings.pinForceN = play.pinForceN.value_or(profile.bodies[root].pinForceN.value_or(settings.pinForceN));
    for (const physics::BodyProfile& body : profile.bodies)
        settings.pins.push_back(body.pinForceN.value_or(0.0F));
    if (play.led.empty()) return settings;
    settings.led.assign(profile.bodies.size(), 0.0F);
    for (const LedPart& part : play.led)
        for (std::size_t body = 0; body < settings.led.size(); ++body)
            if (holds(part.name, profile.bodies[body])) settings.led[body] = part.weight;
    return settings;
}

}  // namespace lutka::scene
