#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "animation/retarget/foot_contacts.hpp"
#include "animation/retarget/retargeter.hpp"

namespace lutka::animation {

/// Mean and most of a figure over a clip.
struct MeanAndMost {
    double mean = 0.0;
    double most = 0.0;
};

/// How far a part points from where the source's does.
struct DirectionError {
    std::string part;  ///< A limb's role ("leftUpperArm"), "leftFoot" (ahead along its sole), "trunk" (from between the
                       ///< hip joints to the neck), "neck", "face" (ahead of the head).
    bool limb = false;  ///< Of arm or leg, foot included: what meanLimbDeg() is over.
    MeanAndMost degrees;
};

/// What a retargeted clip is worth, measured on the poses that were made.
struct RetargetFigures {
    std::vector<DirectionError> directions;
    MeanAndMost slideCm;  ///< How far a standing point strays over the floor from where it began to stand, a contact.
    MeanAndMost sourceSlideCm;  ///< The same of the source, at the target's size.
    MeanAndMost penetrationCm;  ///< The lowest part of a sole below the floor, over all frames.
    MeanAndMost sourcePenetrationCm;
    int contacts = 0;
    float scale = 1.0F;  ///< Target metres a source metre.

    [[nodiscard]] double meanLimbDeg() const;
    [[nodiscard]] double mostLimbDeg() const;
};

/// Takes figures frame by frame.
class RetargetMeter {
  public:
    /// `contacts` are the source's, left and right; `floor` the height of its floor. All must outlive the meter.
    RetargetMeter(const Retargeter& retargeter, const std::array<FootContact, 2>& contacts, float sourceFloor);
    /// The frame that the retargeter posed last, in order.
    void add();
    [[nodiscard]] RetargetFigures result() const;

  private:
    struct Sum {
        double sum = 0.0;
        double most = 0.0;
        int count = 0;
        void add(double value);
        [[nodiscard]] MeanAndMost result() const;
    };
    struct Part {
        std::string name;
        bool limb = false;
        Sum degrees;
    };
    /// Feet of one figure.
    struct Feet {
        Sum slide;
        Sum depth;
        // Per foot and point (heel, ball): where the present contact began and how far it strayed.
        std::array<std::array<vec3, 2>, 2> began{};
        std::array<std::array<float, 2>, 2> strayed{};
    };
    void addDirections();
    // How far a part of the target points from where the source's does, degrees; unset where one of them has it not.
    [[nodiscard]] std::optional<double> limbOff(Role role) const;
    [[nodiscard]] std::optional<double> footOff(Role role) const;
    [[nodiscard]] std::optional<double> neckOff() const;
    [[nodiscard]] double trunkOff() const;
    [[nodiscard]] double axisOff(Role role, const vec3& axis) const;
    void addFeet(const AnatomicalRig& rig, std::span<const RigidTransform> pose, float floor, float toCm, Feet& feet);
    [[nodiscard]] bool stands(std::size_t side, std::size_t point, int frame) const;

    const Retargeter& retargeter_;
    const std::array<FootContact, 2>& contacts_;
    float sourceFloor_;
    int frame_ = 0;
    std::vector<Part> parts_;
    Feet source_;
    Feet target_;
};

}  // namespace lutka::animation
