#include "physics/doctor/shape_faults.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "physics/collision/shape.hpp"
#include "physics/fit/fit_shapes.hpp"

namespace lutka::physics {
namespace {

void addSizeFault(const BodyShape& shape, bool creature, float heightM, std::vector<ShapeFault>& faults) {
    constexpr float kTiny = 0.008F;
    constexpr float kRounding = 0.005F;
    const float most = (creature ? kLargestSegmentRadius : kLargestTrunkRadius) + kRounding;
    const float radius = std::min(halfWidth(shape, {1, 0, 0}), halfWidth(shape, {0, 0, 1}));
    const float share = radius / heightM;
    if (share >= kTiny && share <= most) return;
    faults.push_back(
        {share < kTiny ? "body-tiny" : "body-huge",
         fmt::format("{:.1f} % of the height thick, expected 0.8 to {:.0f}", 100.0F * share, 100.0F * most)});
}

void addSkinFaults(const PlannedBody& body, const PlacedShape& shape, float heightM, std::vector<ShapeFault>& faults) {
    constexpr float kStandsOut = 0.02F;
    constexpr float kUncovered = 0.04F;
    constexpr float kMostShare = 0.25F;
    const RigidTransform bodyFromStandard = inverse(shape.standardFromBody);
    float total = 0.0F;
    float inside = 0.0F;
    float outside = 0.0F;
    for (const SkinPoint& point : body.skin) {
        const float distance = signedDistance(shape.shape, bodyFromStandard * point.position);
        total += point.area;
        if (distance < -kStandsOut * heightM) inside += point.area;
        if (distance > kUncovered * heightM) outside += point.area;
    }
    if (total <= 0.0F) return;
    const auto add = [&](const char* code, float share, const char* what) {
        if (share <= kMostShare) return;
        faults.push_back({code, fmt::format("{:.0f} % of its skin {}, at most 25", 100.0F * share, what)});
    };
    add("capsule-outside-skin", inside / total, "lies more than 2 % of the height inside the shape");
    add("skin-not-covered", outside / total, "lies more than 4 % of the height outside the shape");
}

}  // namespace

bool isShapeFault(std::string_view code) {
    return code == "body-tiny" || code == "body-huge" || code == "capsule-outside-skin" || code == "skin-not-covered";
}

std::vector<ShapeFault> shapeFaults(const PlannedBody& body, const PlacedShape& shape, float heightM) {
    std::vector<ShapeFault> faults;
    addSizeFault(shape.shape, body.segment.has_value(), heightM, faults);
    addSkinFaults(body, shape, heightM, faults);
    return faults;
}

const PlacedShape* NewShapes::without(std::string_view fault, int planned) {
    constexpr int kAll = 1 + static_cast<int>(BodyShape::kMostAdded);
    const auto index = static_cast<std::size_t>(planned);
    const auto faulty = [&](const PlacedShape& shape) {
        const std::vector<ShapeFault> faults = shapeFaults(plan_.bodies[index], shape, heightM_);
        return std::any_of(faults.begin(), faults.end(), [&](const ShapeFault& one) { return one.code == fault; });
    };
    if (few_.empty()) few_ = fitShapes(plan_, anatomy_, mostShapes_);
    if (!faulty(few_[index])) return &few_[index];
    if (mostShapes_ >= kAll) return nullptr;
    if (many_.empty()) many_ = fitShapes(plan_, anatomy_, kAll);
    return faulty(many_[index]) ? nullptr : &many_[index];
}

}  // namespace lutka::physics
