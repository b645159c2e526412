#pragma once

#include "animation/character.hpp"
#include "animation/import/import_character.hpp"

namespace lutka::test {

/// The imported character; fails the test with the error's text when there is none.
[[nodiscard]] animation::Character imported(const std::filesystem::path& file,
                                            const animation::ImportOptions& options = {});

/// Largest distance between a vertex skinned in that pose and `expected` (mesh after mesh).
[[nodiscard]] float largestError(const animation::Character& character,
                                 const std::vector<RigidTransform>& modelFromJoint, const std::vector<vec3>& expected);

/// All vertices in the bind pose, mesh after mesh.
[[nodiscard]] std::vector<vec3> bindVertices(const animation::Character& character);

/// What holds for every import: valid skeleton, arrays of one size, indices in range, weights sorted with sum 1,
/// normals of unit length, skinWeight the sum of the weights, bind pose in and bind pose out, clips of the right size.
void checkInvariants(const animation::Character& character);

/// Whether a warning contains the text.
[[nodiscard]] bool warns(const animation::Character& character, const std::string& text);

}  // namespace lutka::test
