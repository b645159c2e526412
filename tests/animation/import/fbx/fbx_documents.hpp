#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "animation/import/fbx/fbx_writer.hpp"
#include "animation/import/source_scene.hpp"
#include "core/result.hpp"

namespace lutka::test {

using glm::dmat4;
using glm::dvec3;
using Numbers = std::vector<std::pair<std::string, std::vector<double>>>;

/// Of a second.
inline constexpr double kTicks = 46'186'158'000.0;

[[nodiscard]] FbxRecord row(const std::string& name, std::vector<double> numbers);
[[nodiscard]] FbxRecord wholes(const std::string& name, std::vector<std::int32_t> numbers);
[[nodiscard]] FbxRecord model(std::int64_t id, const std::string& name, const Numbers& properties);
[[nodiscard]] std::vector<FbxRecord> document(std::vector<FbxRecord> objects, std::vector<FbxRecord> links);

/// A layer with one curve, in objects 8 to 11 and their links: what turns object 7 by `from` to `to` degrees about x in
/// its first second, with 20 and 30 degrees about y and z.
void addTurn(double from, double to, std::vector<FbxRecord>& objects, std::vector<FbxRecord>& links);

/// Read by our own reader from a file.
[[nodiscard]] Result<animation::rig_import::SourceScene> readBytes(const std::string& bytes);
/// … where it must succeed.
[[nodiscard]] animation::rig_import::SourceScene readAll(const std::vector<FbxRecord>& sections);

[[nodiscard]] dmat4 turn(double degrees, int axis);
[[nodiscard]] dmat4 xyz(const dvec3& degrees);
[[nodiscard]] dmat4 move(const dvec3& by);
/// The length of the longest difference of two columns.
[[nodiscard]] double difference(const dmat4& a, const dmat4& b);

/// All that an FBX node's transform may have, with a rotation of (10, 20, 30) degrees.
[[nodiscard]] const Numbers& pivotsOfAllKinds();
/// The FBX SDK's product of them, with `rotation` in the place of the node's own.
[[nodiscard]] dmat4 pivotsMatrix(const dvec3& rotation);

}  // namespace lutka::test
