#include "physics/world/doll_guard.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lutka::physics {
namespace {

// Half m v² plus half I w², in the bodies' principal axes; not finite when any number of the states is not.
float kineticEnergy(const RagdollProfile& profile, std::span<const BodyState> bodies) {
    float energy = 0.0F;
    float nothing = 0.0F;  // 0 times what does not enter the energy: not a number where that is not finite
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyState& body = bodies[i];
        const vec3& at = body.worldFromBody.translation;
        nothing += 0.0F * (at.x + at.y + at.z);
        const vec3 turn = glm::conjugate(body.worldFromBody.rotation) * body.angularVelocity;
        energy += profile.bodies[i].massKg * glm::dot(body.linearVelocity, body.linearVelocity) +
                  glm::dot(profile.bodies[i].inertia, turn * turn);
    }
    return 0.5F * energy + nothing;
}

float fastest2(std::span<const BodyState> bodies) {
    float most = 0.0F;
    for (const BodyState& body : bodies)
        most = std::max(most, glm::dot(body.linearVelocity, body.linearVelocity));
    return most;
}

}  // namespace

std::string_view textOf(CaughtDoll::Why why) {
    switch (why) {
        case CaughtDoll::Why::notFinite:
            return "a number that is not finite";
        case CaughtDoll::Why::tooFast:
            return "a body faster than 500 m/s";
        case CaughtDoll::Why::energy:
            break;
    }
    return "more energy than it can have been given";
}

void DollGuard::add(DollId id, const RagdollProfile& profile, std::span<const BodyState> bodies) {
    float mass = 0.0F;
    for (const BodyProfile& body : profile.bodies)
        mass += body.massKg;
    entries_.push_back({id,
                        &profile,
                        {bodies.begin(), bodies.end()},
                        kineticEnergy(profile, bodies),
                        0.5F * mass * kMostGain * kMostGain,
                        true});
    scratch_.resize(std::max(scratch_.size(), bodies.size()));
    caught_.reserve(entries_.size());
}

void DollGuard::remove(int doll) {
    entries_.erase(entries_.begin() + doll);
}

void DollGuard::begin(int doll, std::span<const BodyState> bodies) {
    Entry& entry = entries_[doll];
    std::copy(bodies.begin(), bodies.end(), entry.good.begin());
    entry.energy = kineticEnergy(*entry.profile, bodies);
    entry.known = true;
}

std::span<BodyState> DollGuard::scratch(int doll) {
    return std::span(scratch_).first(entries_[doll].good.size());
}

bool DollGuard::judge(int doll, std::span<const BodyState> bodies, double seconds) {
    Entry& entry = entries_[doll];
    const float energy = kineticEnergy(*entry.profile, bodies);
    if (!std::isfinite(energy)) {
        note(entry, CaughtDoll::Why::notFinite, seconds);
        return false;
    }
    const float gain = energy - entry.energy;
    if (fastest2(bodies) > kMostSpeed * kMostSpeed) {
        note(entry, CaughtDoll::Why::tooFast, seconds);
        return false;
    }
    if (gain > entry.mostGain) {
        note(entry, CaughtDoll::Why::energy, seconds);
        return false;
    }
    std::copy(bodies.begin(), bodies.end(), entry.good.begin());
    entry.energy = energy;
    return true;
}

void DollGuard::note(const Entry& entry, CaughtDoll::Why why, double seconds) {
    const auto known =
        std::find_if(caught_.begin(), caught_.end(), [&](const CaughtDoll& one) { return one.doll == entry.id; });
    if (known != caught_.end())
        ++known->times;
    else
        caught_.push_back({entry.id, why, seconds, 1});
}

}  // namespace lutka::physics
