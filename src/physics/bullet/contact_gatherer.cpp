#include "physics/bullet/contact_gatherer.hpp"

#include <cstdint>

#include "physics/bullet/convert.hpp"

namespace lutka::physics {

ContactReport::Side sideOf(const btCollisionObject& object) {
    using Kind = ContactReport::Side::Kind;
    const int user = object.getUserIndex();
    if (user >= 0) return {Kind::doll, user, object.getUserIndex2()};
    return {user == kPropUser ? Kind::prop : Kind::fixed, object.getUserIndex2(), 0};
}

std::size_t ContactGatherer::KeyHash::operator()(const Key& key) const {
    const auto mix = [](std::uint64_t x) { return x * 0x9E3779B97F4A7C15ULL ^ (x >> 31U); };
    return static_cast<std::size_t>(mix(reinterpret_cast<std::uintptr_t>(key.a)) +
                                    3 * mix(reinterpret_cast<std::uintptr_t>(key.b)) +
                                    7 * static_cast<std::uint64_t>(key.feature));
}

void ContactGatherer::clear() {
    reports_.clear();
    known_.clear();
}

void ContactGatherer::gather(btDispatcher& dispatcher) {
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
        const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
        const btCollisionObject& a = *manifold.getBody0();
        const btCollisionObject& b = *manifold.getBody1();
        if (!a.isActive() && !b.isActive()) continue;
        for (int k = 0; k < manifold.getNumContacts(); ++k) {
            const btManifoldPoint& point = manifold.getContactPoint(k);
            if (point.getAppliedImpulse() <= 0.0F) continue;
            const auto [at, fresh] =
                known_.emplace(Key{&a, &b, point.m_index0 >= 0 ? point.m_index0 : -1 - k}, reports_.size());
            if (fresh) reports_.push_back({sideOf(a), sideOf(b), {}, {}, 0.0F});
            ContactReport& report = reports_[at->second];
            report.position = fromBullet(point.getPositionWorldOnB());
            report.normal = fromBullet(point.m_normalWorldOnB);
            report.impulse += point.getAppliedImpulse();
        }
    }
}

}  // namespace lutka::physics
