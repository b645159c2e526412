#include "scene/measure/quality_json.hpp"

namespace lutka::scene {

nlohmann::ordered_json qualityJson(const physics::Quality& q) {
    nlohmann::ordered_json json;
    json["jointSeparationM"] = {
        {"max", q.jointSeparationM.max}, {"p99", q.jointSeparationM.p99}, {"mean", q.jointSeparationM.mean}};
    json["limitViolationDeg"] = {
        {"max", q.limitViolationDeg.max}, {"p99", q.limitViolationDeg.p99}, {"lasting", q.limitViolationDeg.lasting}};
    json["floorPenetrationM"] = {{"max", q.floorPenetrationM}};
    json["selfPenetrationM"] = {{"max", q.selfPenetrationM}};
    json["dollPenetrationM"] = {{"max", q.dollPenetrationM.max}, {"p99", q.dollPenetrationM.p99}};
    json["energyGrowthJ"] = q.energyGrowthJ;
    json["initialEnergyJ"] = q.initialEnergyJ;
    json["settleSeconds"] =
        q.settleSeconds ? nlohmann::ordered_json(*q.settleSeconds) : nlohmann::ordered_json(nullptr);
    json["residualSpeedMps"] = q.residualSpeedMps;
    json["nonFinite"] = q.nonFinite;
    return json;
}

nlohmann::ordered_json fitJson(const physics::FitMeasures& fit) {
    nlohmann::ordered_json json;
    json["vertices"] = fit.vertices;
    json["skinNear"] = fit.skinNear;
    json["volumeCovered"] =
        fit.volumeCovered ? nlohmann::ordered_json(*fit.volumeCovered) : nlohmann::ordered_json(nullptr);
    json["overlapM"] = fit.overlapM;
    return json;
}

}  // namespace lutka::scene
