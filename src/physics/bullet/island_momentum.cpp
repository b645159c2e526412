#include "physics/bullet/island_momentum.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "physics/bullet/convert.hpp"

namespace lutka::physics {
namespace {

using glm::dmat3;
using glm::dvec3;

dvec3 wide(const btVector3& v) {
    return fromBullet(v);
}

// World axes, kg m².
dmat3 inertiaOf(const btRigidBody& body) {
    const dmat3 axes(fromBullet(body.getWorldTransform().getBasis()));
    const dvec3 own = wide(body.getLocalInertia());
    return axes * dmat3(own.x, 0, 0, 0, own.y, 0, 0, 0, own.z) * glm::transpose(axes);
}

// The motion of bodies about their centre of mass.
struct Whole {
    dvec3 centre{0};
    dvec3 momentum{0};
    dmat3 inertia{0};
};

// `given`: what each body's velocity and turn are taken as.
template <class Given>
Whole wholeOf(std::span<const SolverBody> bodies, const Given& given) {
    Whole whole;
    dvec3 drift(0);
    double mass = 0;
    for (const SolverBody& body : bodies) {
        const double own = 1.0 / static_cast<double>(body.inverseMass);
        mass += own;
        whole.centre += own * wide(body.body->getCenterOfMassPosition());
        drift += own * given(body).first;
    }
    whole.centre /= mass;
    drift /= mass;
    for (const SolverBody& body : bodies) {
        const double own = 1.0 / static_cast<double>(body.inverseMass);
        const dvec3 arm = wide(body.body->getCenterOfMassPosition()) - whole.centre;
        const auto [velocity, turn] = given(body);
        const dmat3 inertia = inertiaOf(*body.body);
        whole.momentum += own * glm::cross(arm, velocity - drift) + inertia * turn;
        whole.inertia += inertia + own * (glm::dot(arm, arm) * dmat3(1.0) - glm::outerProduct(arm, arm));
    }
    return whole;
}

}  // namespace

glm::dvec3 momentumBefore(std::span<const SolverBody> bodies, float seconds) {
    const auto given = [&](const SolverBody& taken) {
        const btRigidBody& body = *taken.body;
        const auto span = static_cast<double>(seconds);
        const dvec3 push = wide(body.getTotalForce()) * (static_cast<double>(taken.inverseMass) * span);
        const dvec3 twist = glm::inverse(inertiaOf(body)) * wide(body.getTotalTorque()) * span;
        return std::pair(wide(body.getLinearVelocity()) + push, wide(body.getAngularVelocity()) + twist);
    };
    return wholeOf(bodies, given).momentum;
}

void restoreMomentum(std::span<const SolverBody> bodies, const glm::dvec3& momentum) {
    const Whole whole = wholeOf(bodies, [](const SolverBody& taken) {
        return std::pair(wide(taken.body->getLinearVelocity()), wide(taken.body->getAngularVelocity()));
    });
    const dvec3 turn = glm::inverse(whole.inertia) * (momentum - whole.momentum);
    for (const SolverBody& taken : bodies) {
        btRigidBody& body = *taken.body;
        const dvec3 arm = wide(body.getCenterOfMassPosition()) - whole.centre;
        body.setLinearVelocity(body.getLinearVelocity() + toBullet(vec3(glm::cross(turn, arm))));
        body.setAngularVelocity(body.getAngularVelocity() + toBullet(vec3(turn)));
    }
}

}  // namespace lutka::physics
