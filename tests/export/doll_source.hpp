#pragma once

#include "export/export_ragdoll.hpp"

namespace lutka::test {

/// makeDoll() on makeBiped(), or any other profile of that rig: what exporters take.
class DollSource {
  public:
    DollSource();
    explicit DollSource(physics::RagdollProfile profile);

    [[nodiscard]] exporting::ExportSource source() const { return {character, profile, rig}; }

    animation::Character character;
    physics::RagdollProfile profile;
    physics::Rig rig;
};

/// Worst difference of two poses: metres, and the distance of unit quaternions.
[[nodiscard]] float poseDifference(const RigidTransform& a, const RigidTransform& b);

}  // namespace lutka::test
