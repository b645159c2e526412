#include "scene/puppet/puppet_tally.hpp"

#include <algorithm>
#include <cmath>

namespace lutka::scene {

void TrackingTally::JointTally::add(const JointTally& other) {
    squares += other.squares;
    count += other.count;
    maxDeg = std::max(maxDeg, other.maxDeg);
}

float TrackingTally::JointTally::rmsDeg() const {
    return count > 0 ? static_cast<float>(std::sqrt(squares / static_cast<double>(count))) : 0.0F;
}

TrackingTally::TrackingTally(std::span<const RagdollAsset* const> assets)
    : assets_(assets.begin(), assets.end()), tallies_(assets.size()) {}

void TrackingTally::addJoints(int asset, std::span<const float> errors) {
    std::vector<JointTally>& tallies = tallies_[asset];
    tallies.resize(errors.size());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const float degreesOff = degrees(errors[i]);
        tallies[i].squares += static_cast<double>(degreesOff) * static_cast<double>(degreesOff);
        tallies[i].maxDeg = std::max(tallies[i].maxDeg, degreesOff);
        ++tallies[i].count;
    }
}

void TrackingTally::addRoot(float distanceM) {
    worst_.rootM = std::max(worst_.rootM, distanceM);
}

void TrackingTally::addLed(float distanceM) {
    worst_.ledM = std::max(worst_.ledM, distanceM);
}

void TrackingTally::addFooting(float heightM) {
    worst_.footGapM = std::max(worst_.footGapM, heightM);
    worst_.footDepthM = std::max(worst_.footDepthM, -heightM);
    gapsM_ += static_cast<double>(std::max(heightM, 0.0F));
    ++standing_;
}

void TrackingTally::addSlide(float distanceM) {
    worst_.footSlideM = std::max(worst_.footSlideM, distanceM);
}

void TrackingTally::addRecovery(float seconds) {
    worst_.recoverySeconds = std::max(worst_.recoverySeconds, seconds);
}

// By the name of the body below, in the order of the profiles; characters that share a name share its figures.
std::vector<std::pair<std::string, TrackingTally::JointTally>> TrackingTally::jointTallies() const {
    std::vector<std::pair<std::string, JointTally>> joints;
    for (std::size_t asset = 0; asset < tallies_.size(); ++asset) {
        const physics::RagdollProfile& profile = assets_[asset]->profile;
        for (std::size_t i = 0; i < tallies_[asset].size(); ++i) {
            const std::string& name = profile.bodies[profile.constraints[i].child].name;
            auto known = std::find_if(joints.begin(), joints.end(), [&](const auto& one) { return one.first == name; });
            if (known == joints.end()) known = joints.insert(joints.end(), {name, {}});
            known->second.add(tallies_[asset][i]);
        }
    }
    return joints;
}

PuppetFigures TrackingTally::figures() const {
    PuppetFigures figures = worst_;
    JointTally all;
    for (const auto& [name, tally] : jointTallies()) {
        if (tally.maxDeg > all.maxDeg) figures.worstJoint = name;
        all.add(tally);
        figures.joints.push_back({name, tally.rmsDeg(), tally.maxDeg});
    }
    figures.rmsDeg = all.rmsDeg();
    figures.maxDeg = all.maxDeg;
    figures.footGapMeanM = standing_ > 0 ? static_cast<float>(gapsM_ / static_cast<double>(standing_)) : 0.0F;
    return figures;
}

void GetUpTally::begin(float distanceM) {
    ++figures_.begun;
    matchedM_ += static_cast<double>(distanceM);
}

void GetUpTally::stand(float seconds) {
    ++figures_.stood;
    seconds_ += static_cast<double>(seconds);
    figures_.mostSeconds = std::max(figures_.mostSeconds, seconds);
}

void GetUpTally::turn(float stepDeg, const std::string& body) {
    if (stepDeg <= figures_.mostStepDeg) return;
    figures_.mostStepDeg = stepDeg;
    figures_.stepJoint = body;
}

void GetUpTally::slide(float distanceM) {
    figures_.mostSlideM = std::max(figures_.mostSlideM, distanceM);
}

GetUpFigures GetUpTally::figures() const {
    GetUpFigures figures = figures_;
    if (figures.stood > 0) figures.meanSeconds = static_cast<float>(seconds_ / figures.stood);
    if (figures.begun > 0) figures.meanDistanceM = static_cast<float>(matchedM_ / figures.begun);
    return figures;
}

}  // namespace lutka::scene
