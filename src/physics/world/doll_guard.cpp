#include "physics/world/doll_guard.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lutka::physics {
namespace {

// How a doll moves, at most.
struct Motion {
    float energy = 0.0F;    // joules: half m v² plus half I w², each body turning about its most inert axis
    float fastest2 = 0.0F;  // m²/s², of any body's centre
};

// Its energy is not finite when any number of the states is not.
Motion motionOf(const RagdollProfile& profile, std::span<const BodyState> bodies) {
    Motion motion;
    float nothing = 0.0F;  // 0 times what does not enter the energy: not a number where that is not finite
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyState& body = bodies[i];
        const vec3& at = body.worldFromBody.translation;
        const quat& turn = body.worldFromBody.rotation;
        nothing += 0.0F * (at.x + at.y + at.z + turn.x + turn.y + turn.z + turn.w);
        const vec3& inertia = profile.bodies[i].inertia;
        const float speed2 = glm::dot(body.linearVelocity, body.linearVelocity);
        motion.fastest2 = std::max(motion.fastest2, speed2);
        motion.energy += profile.bodies[i].massKg * speed2 + std::max({inertia.x, inertia.y, inertia.z}) *
                                                                 glm::dot(body.angularVelocity, body.angularVelocity);
    }
    motion.energy = 0.5F * motion.energy + nothing;
    return motion;
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
                        motionOf(profile, bodies).energy,
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
    entry.energy = motionOf(*entry.profile, bodies).energy;
    entry.known = true;
}

std::span<BodyState> DollGuard::scratch(int doll) {
    return std::span(scratch_).first(entries_[doll].good.size());
}

bool DollGuard::judge(int doll, std::span<const BodyState> bodies, double seconds) {
    Entry& entry = entries_[doll];
    const Motion motion = motionOf(*entry.profile, bodies);
    if (!std::isfinite(motion.energy)) {
        note(entry, CaughtDoll::Why::notFinite, seconds);
        return false;
    }
    const float gain = motion.energy - entry.energy;
    if (motion.fastest2 > kMostSpeed * kMostSpeed) {
        note(entry, CaughtDoll::Why::tooFast, seconds);
        return false;
    }
    if (gain > entry.mostGain) {
        note(entry, CaughtDoll::Why::energy, seconds);
        return false;
    }
    std::copy(bodies.begin(), bodies.end(), entry.good.begin());
    entry.energy = motion.energy;
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
