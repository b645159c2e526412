#pragma once

namespace lutka::physics::profile_format {

/// What marks a document as a ragdoll profile, and the schema that editors check it against.
inline constexpr const char* kName = "lutka-ragdoll";
inline constexpr const char* kSchema = "ragdoll.schema.json";

/// More bodies than roles can never be right; a document that claims more is refused before anything is read.
inline constexpr int kMostBodies = 64;
inline constexpr int kMostPairs = kMostBodies * kMostBodies / 2;

}  // namespace lutka::physics::profile_format
