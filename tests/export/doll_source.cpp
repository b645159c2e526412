#include "export/doll_source.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "support/catch.hpp"
#include "support/dolls.hpp"
#include "support/rigs.hpp"

namespace lutka::test {

DollSource::DollSource() : DollSource(makeDoll()) {}

DollSource::DollSource(physics::RagdollProfile p) : character(makeBiped()), profile(std::move(p)) {
    auto bound = physics::bindRig(profile, character.skeleton);
    REQUIRE(bound);
    rig = std::move(bound).value();
}

physics::AddedShape hornOfHead() {
    physics::AddedShape horn;
    horn.radius = 0.03F;
    horn.halfLength = 0.08F;
    horn.bodyFromShape = {glm::angleAxis(0.6F, glm::normalize(vec3(1, 2, 0.5F))), {0.05F, 0.1F, -0.02F}};
    return horn;
}

exporting::Exported exportedAs(exporting::ExportFormat format, const DollSource& doll) {
    auto exported = exporting::exportRagdoll(format, doll.source());
    REQUIRE(exported);
    return std::move(exported).value();
}

int occurrences(const std::string& text, const std::string& what) {
    int found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++found;
    return found;
}

float poseDifference(const RigidTransform& a, const RigidTransform& b) {
    const float turn = std::min(glm::length(a.rotation - b.rotation), glm::length(a.rotation + b.rotation));
    return std::max(glm::distance(a.translation, b.translation), turn);
}

}  // namespace lutka::test
