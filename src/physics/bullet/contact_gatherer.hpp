#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <span>
#include <vector>

#include "physics/world/world.hpp"

namespace lutka::physics {

/// Sums up the contacts of a step's substeps.
class ContactGatherer {
  public:
    void clear();
    /// Adds what the manifolds hold now.
    void gather(btDispatcher& dispatcher);
    [[nodiscard]] std::span<const ContactReport> reports() const { return reports_; }

  private:
    struct Key {
        const btCollisionObject* a;
        const btCollisionObject* b;
        int feature;
        bool operator==(const Key&) const = default;
    };
    [[nodiscard]] static std::size_t hashOf(const Key& key);
    // The report of a contact; what it was told before stays.
    ContactReport& reportOf(const Key& key);
    void grow();

    std::vector<ContactReport> reports_;
    std::vector<Key> keys_;          // one a report
    std::vector<int> reportOfSlot_;  // open addressing, a power of two; -1: empty. Kept from step to step.
};

/// Tells an object of the world what the world calls it, in its three user indices; its user pointer stays free.
void name(btCollisionObject& object, StaticId id);
void name(btCollisionObject& object, PropId id);
void name(btCollisionObject& object, DollId id, int body);
/// What it was told.
[[nodiscard]] ContactReport::Side sideOf(const btCollisionObject& object);

}  // namespace lutka::physics
