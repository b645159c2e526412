#pragma once

namespace lutka::physics {

/// Coulomb's coefficients. That of a contact is the product of both sides', which is Bullet's rule: by these 0.4 for a
/// doll on the ground and 0.25 for a doll on another or on itself.
inline constexpr float kBodyFriction = 0.5F;    ///< Every body of a doll, and every prop.
inline constexpr float kStaticFriction = 0.8F;  ///< Static geometry of which nothing else is said.

}  // namespace lutka::physics
