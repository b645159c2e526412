#pragma once

#include <string>

#include "physics/doctor/doctor.hpp"
#include "physics/profile/profile.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/measure/checkup.hpp"

/// Parts of a model's page, each as HTML; what comes from files is escaped.
namespace lutka::reporting {

/// A word on the whole: "Sound" …
[[nodiscard]] std::string verdictOf(const scene::Checkup& checkup);
/// The class of a score's colour: good, fair or poor.
[[nodiscard]] const char* scoreClass(float score);
/// A ring with the score in it.
[[nodiscard]] std::string scoreRing(float score);
/// The parts of the score as bars.
[[nodiscard]] std::string scorePartsHtml(const scene::Checkup& checkup);
/// Height, mass, bodies, joints, skin and fit, as a list of terms.
[[nodiscard]] std::string factsHtml(const scene::RagdollAsset& asset, const scene::Checkup& checkup);
/// What was measured in the drops beside what is allowed.
[[nodiscard]] std::string boundsTable(const scene::Checkup& checkup);
[[nodiscard]] std::string findingsHtml(const physics::Diagnosis& diagnosis);
/// Role, joint, how sure and why; of a ragdoll without roles which joint each body stands for.
[[nodiscard]] std::string mappingTable(const scene::RagdollAsset& asset);
/// Masses, shapes and limits.
[[nodiscard]] std::string bodiesTable(const physics::RagdollProfile& profile);
/// What import, mapper and profile told, as a list; empty when they told nothing.
[[nodiscard]] std::string notesHtml(const scene::RagdollAsset& asset);

}  // namespace lutka::reporting
