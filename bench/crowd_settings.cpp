#include "crowd_settings.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <map>

namespace lutka::bench {

void apply(physics::crowd::CrowdTuning& tuning, const std::string& setting) {
    const std::size_t at = setting.find('=');
    const std::string name = setting.substr(0, at);
    const float value = at == std::string::npos ? 0.0F : std::stof(setting.substr(at + 1));
    const std::map<std::string, float*> reals{{"jointErp", &tuning.jointErp},
                                              {"limitErp", &tuning.limitErp},
                                              {"contactErp", &tuning.contactErp},
                                              {"jointStiffness", &tuning.jointStiffness},
                                              {"mendGap", &tuning.mendGap},
                                              {"wedgeDepth", &tuning.wedgeDepth},
                                              {"wedgeFirmness", &tuning.wedgeFirmness},
                                              {"mendAngle", &tuning.mendAngle},
                                              {"aimGap", &tuning.aimGap},
                                              {"mendRate", &tuning.mendRate},
                                              {"mendHaste", &tuning.mendHaste},
                                              {"dollPushSpeed", &tuning.dollPushSpeed},
                                              {"supportPassed", &tuning.supportPassed},
                                              {"supportKept", &tuning.supportKept},
                                              {"nearSpeed", &tuning.nearSpeed},
                                              {"answerSpeed", &tuning.answerSpeed},
                                              {"ownDepth", &tuning.ownDepth},
                                              {"ownSpeed", &tuning.ownSpeed},
                                              {"heapDepth", &tuning.heapDepth},
                                              {"heapSpeed", &tuning.heapSpeed},
                                              {"ownMass", &tuning.ownMass},
                                              {"ownBlow", &tuning.ownBlow},
                                              {"ownLoad", &tuning.ownLoad},
                                              {"sideways", &tuning.sideways},
                                              {"contactTolerance", &tuning.contactTolerance},
                                              {"limitTolerance", &tuning.limitTolerance},
                                              {"firstTouch", &tuning.firstTouch},
                                              {"limitStiffness", &tuning.limitStiffness},
                                              {"contactStiffness", &tuning.contactStiffness},
                                              {"grip", &tuning.grip},
                                              {"pushSpeed", &tuning.pushSpeed},
                                              {"ownPushSpeed", &tuning.ownPushSpeed},
                                              {"limitSpeed", &tuning.limitSpeed},
                                              {"slop", &tuning.slop},
                                              {"staticMargin", &tuning.staticMargin},
                                              {"shapeMargin", &tuning.shapeMargin},
                                              {"pairMargin", &tuning.pairMargin},
                                              {"rollingLever", &tuning.rollingLever},
                                              {"linearDamping", &tuning.linearDamping},
                                              {"calmSpeed", &tuning.calmSpeed},
                                              {"calmDamping", &tuning.calmDamping},
                                              {"stiction", &tuning.stiction},
                                              {"jointStiction", &tuning.jointStiction},
                                              {"stictionRate", &tuning.stictionRate},
                                              {"stiffen", &tuning.stiffen},
                                              {"stiffest", &tuning.stiffest},
                                              {"sleepSpeed", &tuning.sleepSpeed},
                                              {"substepSpeed", &tuning.substepSpeed},
                                              {"substepTurn", &tuning.substepTurn},
                                              {"fastSpeed", &tuning.fastSpeed},
                                              {"fastTurn", &tuning.fastTurn},
                                              {"spared", &tuning.spared},
                                              {"deepShare", &tuning.deepShare},
                                              {"angularDamping", &tuning.angularDamping},
                                              {"leastGyration", &tuning.leastGyration}};
    const std::map<std::string, int*> whole{
        {"substeps", &tuning.substeps},         {"fastSubsteps", &tuning.fastSubsteps},
        {"calmSubsteps", &tuning.calmSubsteps}, {"passes", &tuning.passes},
        {"patience", &tuning.patience},         {"mendEvery", &tuning.mendEvery},
        {"restSubsteps", &tuning.restSubsteps}, {"answerSweeps", &tuning.answerSweeps},
        {"ownSweeps", &tuning.ownSweeps},       {"mendSweeps", &tuning.mendSweeps}};
    if (const auto real = reals.find(name); real != reals.end())
        *real->second = value;
    else if (const auto number = whole.find(name); number != whole.end())
        *number->second = static_cast<int>(value);
    else if (name == "baseline")
        tuning.instructionSet = physics::crowd::InstructionSet::baseline;
    else if (name == "avx2")
        tuning.instructionSet = physics::crowd::InstructionSet::avx2;
    else
        fmt::print(stderr, "there is no setting '{}'\n", name);
}

}  // namespace lutka::bench
