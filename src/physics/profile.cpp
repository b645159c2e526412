#include "physics/profile.hpp"

namespace lutka::physics {

int bodyOf(const RagdollProfile& profile, Role role) {
    for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
        if (profile.bodies[body].role == role) return static_cast<int>(body);
    }
    return -1;
}

}  // namespace lutka::physics
