#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <unordered_map>
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
    struct KeyHash {
        std::size_t operator()(const Key& key) const;
    };
    std::vector<ContactReport> reports_;
    std::unordered_map<Key, std::size_t, KeyHash> known_;
};

/// How bodies of the world say what they are: see sideOf().
inline constexpr int kStaticUser = -1;
inline constexpr int kPropUser = -2;
/// User index: the doll's, kStaticUser or kPropUser; second user index: the body's, the static's or the prop's.
[[nodiscard]] ContactReport::Side sideOf(const btCollisionObject& object);

}  // namespace lutka::physics
