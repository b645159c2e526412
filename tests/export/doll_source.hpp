#pragma once

#include <string>

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

/// A capsule aslant in makeDoll()'s head, which is body kHornedBody.
[[nodiscard]] physics::AddedShape hornOfHead();
inline constexpr int kHornedBody = 3;

/// The doll in that format; REQUIREs that it can be written.
[[nodiscard]] exporting::Exported exportedAs(exporting::ExportFormat format, const DollSource& doll);

/// How often `what` stands in `text`.
[[nodiscard]] int occurrences(const std::string& text, const std::string& what);

/// Worst difference of two poses: metres, and the distance of unit quaternions.
[[nodiscard]] float poseDifference(const RigidTransform& a, const RigidTransform& b);

}  // namespace lutka::test
