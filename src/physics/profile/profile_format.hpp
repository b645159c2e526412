#pragma once

#include "physics/profile/profile.hpp"

namespace lutka::physics::profile_format {

/// What marks a document as a ragdoll profile, and the schema that editors check it against.
inline constexpr const char* kName = "lutka-ragdoll";
inline constexpr const char* kSchema = "ragdoll.schema.json";

inline constexpr int kMostPairs = RagdollProfile::kMostBodies * RagdollProfile::kMostBodies / 2;

}  // namespace lutka::physics::profile_format
