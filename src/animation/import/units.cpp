#include "animation/import/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/aabb.hpp"
#include "core/letter_case.hpp"

namespace lutka::animation::rig_import {
namespace {

constexpr double kLeastHeight = 0.3;
constexpr double kMostHeight = 3.5;
constexpr double kUsualHeight = 1.75;
constexpr double kLeastHand = 0.08;  // metres, along its longest side
constexpr double kMostHand = 0.6;
constexpr double kUsualHand = 0.19;
constexpr int kFewestFingerJoints = 8;

// Rotation that takes the axis to +Y; the two others keep a right-handed order.
dmat3 yFrom(UpAxis up) {
    switch (up) {
        case UpAxis::positiveX:
            return {dvec3(0, 1, 0), dvec3(-1, 0, 0), dvec3(0, 0, 1)};
        case UpAxis::negativeX:
            return {dvec3(0, -1, 0), dvec3(1, 0, 0), dvec3(0, 0, 1)};
        case UpAxis::positiveY:
            return dmat3(1.0);
        case UpAxis::negativeY:
            return {dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(0, 0, -1)};
        case UpAxis::positiveZ:
            return {dvec3(1, 0, 0), dvec3(0, 0, -1), dvec3(0, 1, 0)};
        case UpAxis::negativeZ:
            return {dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(0, -1, 0)};
    }
    return dmat3(1.0);
}

const char* nameOf(UpAxis up) {
    constexpr std::array<const char*, 6> kNames = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
    return kNames[static_cast<std::size_t>(up)];
}

UpAxis axisOf(int axis, bool positive) {
    return static_cast<UpAxis>(2 * axis + (positive ? 0 : 1));
}

using Extents = AabbOf<dvec3>;

// Of no points: a box without a size at the origin.
Extents extentsOf(std::span<const vec3> points) {
    Extents out;
    for (const vec3& point : points) {
        if (isFinite(point)) out.add(dvec3(point));
    }
    return out.empty() ? Extents{dvec3(0), dvec3(0)} : out;
}

// A figure flat along the stated axis that stands on the origin along another one, the same on both sides of the third:
// then it is that other axis. Anything less clear is left alone.
std::optional<UpAxis> contradictingUp(const Extents& box, UpAxis stated) {
    const int up = static_cast<int>(stated) / 2;
    const dvec3 size = box.size();
    std::optional<UpAxis> found;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == up || size[axis] < 2.5 * size[up]) continue;
        const int side = 3 - up - axis;
        const bool symmetric = std::abs(box.low[side] + box.high[side]) < 0.1 * size[side];
        const bool standsUpright = std::abs(box.low[axis]) < 0.06 * size[axis];
        const bool hangsDown = std::abs(box.high[axis]) < 0.06 * size[axis];
        if (!symmetric || standsUpright == hangsDown) continue;
        if (found) return std::nullopt;
        found = axisOf(axis, standsUpright);
    }
    return found;
}

void settleUp(const SourceConvention& convention, const Extents& box, const ImportOptions& options, UnitsAndAxes& out,
              std::vector<std::string>& warnings) {
    UpAxis up = UpAxis::positiveY;
    if (options.up) {
        up = *options.up;
        out.info.upSource = "--up";
    } else {
        up = convention.up.value_or(UpAxis::positiveY);
        out.info.upSource = convention.up ? convention.upSource : "assumed";
        if (const auto other = contradictingUp(box, up)) {
            warnings.push_back(
                fmt::format("{} is up {}, but the figure lies flat that way and stands along {}, which is taken "
                            "instead (--up overrides)",
                            nameOf(up), convention.up ? "according to " + convention.upSource : "as nothing is stated",
                            nameOf(*other)));
            up = *other;
            out.info.upSource = "the figure";
        }
    }
    out.info.upAxis = nameOf(up);
    out.rotation = yFrom(up);
}

// An animal on four legs is longer than it is tall, which no figure is, arms stretched out or not.
constexpr double kAnimalLength = 1.6;

// The usual unit under which the figure is as tall as a person, or an animal as long, in metres. Only people come in
// inches, from motion capture.
std::optional<double> usualUnit(double height, bool metric = false) {
    constexpr double kCmu = 0.0254 / 0.45;  // of the CMU motion capture database: inches, divided by 0.45
    // CMU's before the decimetre: its people stand astride, and are no giants of 2.4 m.
    constexpr std::array<double, 9> kUnits = {1.0, 0.01, kCmu, 0.1, 0.0254, 0.001, 10.0, 100.0, 1000.0};
    for (const auto& [least, most] : {std::pair{1.4, 2.1}, std::pair{0.8, 2.5}}) {
        for (const double unit : kUnits) {
            if (metric && (unit == kCmu || unit == 0.0254)) continue;
            if (height * unit >= least && height * unit <= most) return unit;
        }
    }
    return std::nullopt;
}

// As usualUnit(), of a hand.
std::optional<double> usualUnitOfHand(double longest) {
    for (const double unit : {1.0, 0.01, 0.1, 0.001, 0.0254}) {
        if (longest * unit >= kLeastHand && longest * unit <= kMostHand) return unit;
    }
    return std::nullopt;
}

void settleScale(const SourceConvention& convention, const Extents& box, Subject subject, const ImportOptions& options,
                 UnitsAndAxes& out, std::vector<std::string>& warnings) {
    if (options.metresPerFileUnit) {
        out.scale = *options.metresPerFileUnit;
        out.info.unitSource = "--scale";
        return;
    }
    // The figure may lie, or the axis be unknown: then its longest side is its height.
    const dvec3 size = glm::abs(out.rotation * box.size());
    const double longest = std::max({size.x, size.y, size.z});
    const bool hand = subject == Subject::hand;
    const double height = hand || size.y < 0.3 * longest ? longest : size.y;
    const double least = hand ? kLeastHand : kLeastHeight;
    const double most = hand ? kMostHand : kMostHeight;
    const std::optional<double> stated = convention.metresPerUnit;
    const std::string& source = convention.unitSource;
    if (stated && (height * *stated >= least || !(height > 0.0)) && height * *stated <= most) {
        out.scale = *stated;
        out.info.unitSource = source;
        return;
    }
    if (!(height > 0.0) || !std::isfinite(height)) {
        out.scale = stated.value_or(1.0);
        out.info.unitSource = stated ? source : "assumed";
        return;
    }
    const bool animal = longest > kAnimalLength * height;
    std::optional<double> usual = hand     ? usualUnitOfHand(longest)
                                  : animal ? usualUnit(longest, true)
                                           : usualUnit(height);
    if (!usual && animal && !hand) usual = usualUnit(height);  // a person with wings or a staff
    out.scale = usual.value_or((hand ? kUsualHand : kUsualHeight) / height);
    out.info.unitSource = "height of the figure";
    const std::string why = stated
                                ? fmt::format("by {} the figure would be {:.3g} m tall", source, height * *stated)
                                : fmt::format("the file states no unit, and the figure is {:.4g} units tall", height);
    if (stated || out.scale != 1.0) {
        warnings.push_back(fmt::format("{}: took {:.4g} m a unit, which makes it {:.3g} m (--scale overrides)", why,
                                       out.scale, height * out.scale));
    }
}

// Everything after import takes the figure to stand near the origin; single precision wears out far from it, too.
void settlePlace(const Extents& box, UnitsAndAxes& out, std::vector<std::string>& warnings) {
    constexpr double kFar = 4.0;  // sizes of the figure
    const dvec3 size = out.scale * glm::abs(out.rotation * box.size());
    const dvec3 centre = out.scale * (out.rotation * box.middle());
    const double extent = std::max({size.x, size.y, size.z});
    const double away = glm::length(dvec3(centre.x, centre.y - 0.5 * size.y, centre.z));
    if (!(extent > 0.0) || !(away > kFar * extent)) return;
    out.translation = -dvec3(centre.x, centre.y - 0.5 * size.y, centre.z);
    warnings.push_back(fmt::format("the figure stands {:.4g} m from the origin and was brought to it", away));
}

}  // namespace

dmat4 UnitsAndAxes::modelFromScene() const {
    dmat4 matrix(scale * rotation);
    matrix[3] = dvec4(translation, 1.0);
    return matrix;
}

Subject subjectOf(std::span<const std::string> jointNames) {
    constexpr std::array kFingers{"thumb",  "index",  "middle",     "ring",   "pinky",
                                  "little", "finger", "metacarpal", "phalanx"};
    constexpr std::array kTrunk{"hip",       "pelvis",    "spine",   "chest",   "torso",    "waist",
                                "neck",      "head",      "leg",     "foot",    "thigh",    "knee",
                                "toe",       "shoulder",  "clav",    "elbow",   "upperarm", "fore_arm",
                                "upper_arm", "lower_arm", "forearm", "lowerarm"};
    constexpr double kMostAreFingers = 0.7;  // a whole figure of words that are not known here has as many others
    int fingers = 0;
    for (const std::string& name : jointNames) {
        const std::string low = lowerCased(name);
        const auto holds = [&](const char* word) { return low.find(word) != std::string::npos; };
        if (std::any_of(kTrunk.begin(), kTrunk.end(), holds)) return Subject::figure;
        fingers += std::any_of(kFingers.begin(), kFingers.end(), holds) ? 1 : 0;
    }
    const bool most = fingers >= kMostAreFingers * static_cast<double>(jointNames.size());
    return most && fingers >= kFewestFingerJoints ? Subject::hand : Subject::figure;
}

UnitsAndAxes settleUnits(const SourceConvention& convention, std::span<const vec3> points, Subject subject,
                         const ImportOptions& options, std::vector<std::string>& warnings) {
    UnitsAndAxes out;
    const Extents box = extentsOf(points);
    settleUp(convention, box, options, out, warnings);
    settleScale(convention, box, subject, options, out, warnings);
    settlePlace(box, out, warnings);
    out.info.metresPerFileUnit = static_cast<float>(out.scale);
    return out;
}

}  // namespace lutka::animation::rig_import
