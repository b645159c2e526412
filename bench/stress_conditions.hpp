#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "physics/fit/fit_options.hpp"
#include "physics/world/world.hpp"

namespace lutka::bench {

/// What a condition may do while it runs.
struct StressRun {
    physics::World& world;
    const physics::RagdollProfile& profile;
    std::vector<physics::BodyState> start;  ///< Where and how the first doll began.
    Random random{1};
    std::vector<physics::DragId> drags;
};

/// A fall that differs from those of lutka_falls in one respect. What is left alone is as there: a frame of 1/60 s, the
/// earth's gravity, the scene's own friction, a figure of the file's own size with 75 kg.
struct StressCondition {
    std::string name;
    std::string scene = "drop";
    float seconds = 6.0F;
    std::vector<float> frames{1.0F / 60.0F};  ///< Seconds of the frames, over and over.
    vec3 gravity{0, -9.81F, 0};               ///< m/s²
    float friction = -1.0F;                   ///< Of static geometry; below 0: the scene's.
    float heightM = 0.0F;                     ///< Of the figure; 0: the file's.
    physics::FitOptions fit = {};
    bool sleeping = true;
    float measuredFrom = 0.0F;  ///< Seconds; later where the start is wrong by design.
    float creepFrom = 0.0F;     ///< Seconds from which on nothing should move any more; 0: it may.
    /// The first doll has to stay on this side of the wall (z below it); 0: there is none.
    float wall = 0.0F;
    int dolls = 1;
    bool addsEnergy = false;  ///< By ways that no meter counts.
    std::function<void(physics::RagdollProfile&)> change = {};
    std::function<void(std::vector<physics::BodyState>&, const physics::RagdollProfile&, Random&)> place = {};
    std::function<void(std::vector<physics::StaticShape>&)> build = {};
    std::function<void(StressRun&, int step, double seconds)> act = {};
};

[[nodiscard]] std::vector<StressCondition> stressConditions();

}  // namespace lutka::bench
