#include "physics/bullet/contact_gatherer.hpp"

#include <algorithm>
#include <cstdint>

#include "physics/bullet/convert.hpp"

namespace lutka::physics {

namespace {

// User index: what kind of thing it is, and for a body of a doll which one. The other two: its id.
constexpr int kStaticUser = -1;
constexpr int kPropUser = -2;

template <class IdType>
IdType idOf(const btCollisionObject& object) {
    return {object.getUserIndex2(), static_cast<std::uint32_t>(object.getUserIndex3())};
}

template <class IdType>
void setUser(btCollisionObject& object, int kind, IdType id) {
    object.setUserIndex(kind);
    object.setUserIndex2(id.index);
    object.setUserIndex3(static_cast<int>(id.generation));
}

}  // namespace

void name(btCollisionObject& object, StaticId id) {
    setUser(object, kStaticUser, id);
}

void name(btCollisionObject& object, PropId id) {
    setUser(object, kPropUser, id);
}

void name(btCollisionObject& object, DollId id, int body) {
    setUser(object, body, id);
}

ContactReport::Side sideOf(const btCollisionObject& object) {
    using Kind = ContactReport::Side::Kind;
    const int user = object.getUserIndex();
    if (user == kPropUser) return {Kind::prop, {}, idOf<PropId>(object), {}, 0};
    if (user == kStaticUser) return {Kind::fixed, {}, {}, idOf<StaticId>(object), 0};
    return {Kind::doll, idOf<DollId>(object), {}, {}, user};
}

std::size_t ContactGatherer::hashOf(const Key& key) {
    const auto mix = [](std::uint64_t x) { return x * 0x9E3779B97F4A7C15ULL ^ (x >> 31U); };
    return static_cast<std::size_t>(mix(reinterpret_cast<std::uintptr_t>(key.a)) +
                                    3 * mix(reinterpret_cast<std::uintptr_t>(key.b)) +
                                    7 * static_cast<std::uint64_t>(key.feature));
}

void ContactGatherer::clear() {
    if (!reports_.empty()) std::fill(reportOfSlot_.begin(), reportOfSlot_.end(), -1);
    reports_.clear();
    keys_.clear();
}

void ContactGatherer::grow() {
    reportOfSlot_.assign(std::max<std::size_t>(64, 2 * reportOfSlot_.size()), -1);
    const std::size_t mask = reportOfSlot_.size() - 1;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        std::size_t at = hashOf(keys_[i]) & mask;
        while (reportOfSlot_[at] >= 0)
            at = (at + 1) & mask;
        reportOfSlot_[at] = static_cast<int>(i);
    }
}

ContactReport& ContactGatherer::reportOf(const Key& key) {
    if (2 * (reports_.size() + 1) > reportOfSlot_.size()) grow();
    const std::size_t mask = reportOfSlot_.size() - 1;
    std::size_t at = hashOf(key) & mask;
    for (; reportOfSlot_[at] >= 0; at = (at + 1) & mask)
        if (keys_[reportOfSlot_[at]] == key) return reports_[reportOfSlot_[at]];
    reportOfSlot_[at] = static_cast<int>(reports_.size());
    keys_.push_back(key);
    return reports_.emplace_back(ContactReport{sideOf(*key.a), sideOf(*key.b), {}, {}, 0.0F});
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
            ContactReport& report = reportOf({&a, &b, point.m_index0 >= 0 ? point.m_index0 : -1 - k});
            report.position = fromBullet(point.getPositionWorldOnB());
            report.normal = fromBullet(point.m_normalWorldOnB);
            report.impulse += point.getAppliedImpulse();
        }
    }
}

}  // namespace lutka::physics
