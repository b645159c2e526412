#include "scene/measure/puppet_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lutka::scene {
nlohmann::ordered_json trackingJson(const PuppetFigures& figures) {
    nlohmann::ordered_json joints = nlohmann::ordered_json::object();
    for (const JointFigures& joint : figures.joints)
        joints[joint.name] = {{"rms", joint.rmsDeg}, {"max", joint.maxDeg}};
    return {{"rms", figures.rmsDeg}, {"max", figures.maxDeg}, {"worst", figures.worstJoint}, {"joints", joints}};
}

nlohmann::ordered_json secondsJson(float seconds) {
    return seconds < 0.0F ? nlohmann::ordered_json() : nlohmann::ordered_json(seconds);
}

nlohmann::ordered_json puppetJson(const PuppetCast& cast, const physics::WorldView& world) {
    const PuppetFigures figures = cast.figures();
    const physics::PuppetSettings first = cast.settingsOfFirst();
    nlohmann::ordered_json json = {
        {"clip", cast.settings().start.clip},
        {"strength", first.muscles.strength},
        {"frequencyHz", first.muscles.frequencyHz},
        {"dampingRatio", first.muscles.dampingRatio},
        {"pinForceN", first.pinForceN},
        {"kinematicBodies", std::count_if(first.led.begin(), first.led.end(), [](float w) { return w >= 1.0F; })},
        {"trackingErrorDeg", trackingJson(figures)},
        {"clipTurned", {{"maxDeg", figures.clipReachDeg}, {"joint", figures.clipReachJoint}}},
        {"rootErrorM", figures.rootM},
        {"ledErrorM", figures.ledM},
        {"footSlideM", figures.footSlideM},
        {"footing", {{"gapMeanM", figures.footGapMeanM}, {"gapM", figures.footGapM}, {"depthM", figures.footDepthM}}},
        {"motorWorkJ", world.motorWork()},
        {"pinWorkJ", world.dragWork()},
        {"pinImpulseNs", world.dragImpulse()},
        {"hitWorkJ", world.impulseWork()},
        {"knockOuts", figures.knockOuts},
        {"limp", figures.limp},
        {"recoverySeconds", secondsJson(figures.recoverySeconds)}};
    if (cast.settings().getUp) {
        const GetUpFigures up = cast.getUpFigures();
        json["getUp"] = {{"begun", up.begun},
                         {"stood", up.stood},
                         {"seconds", {{"mean", up.meanSeconds}, {"max", up.mostSeconds}}},
                         {"largestStepDeg", up.mostStepDeg},
                         {"largestStepJoint", up.stepJoint},
                         {"footSlideM", up.mostSlideM},
                         {"poseDistanceM", up.meanDistanceM}};
    }
    return json;
}

std::string puppetText(const PuppetCast& cast, const physics::WorldView& world) {
    const PuppetFigures figures = cast.figures();
    // A figure without a joint is one that nobody was measured for.
    const auto at = [](const std::string& joint) { return joint.empty() ? joint : fmt::format(" ({})", joint); };
    std::string text = fmt::format("  behind the pose    {:7.2f} deg RMS, {:.2f} deg at most{}, root {:.1f} cm\n",
                                   figures.rmsDeg, figures.maxDeg, at(figures.worstJoint), figures.rootM * 1e2F);
    if (figures.clipReachDeg > 1.0F)
        text += fmt::format("  the clip itself    {:7.1f} deg at most beyond what its joints can do ({})\n",
                            figures.clipReachDeg, figures.clipReachJoint);
    text += fmt::format("  feet slid          {:7.1f} cm at most while they stood\n", figures.footSlideM * 1e2F);
    text += fmt::format("  work               {:7.1f} J by muscles, {:.1f} J and {:.1f} N s by pins\n",
                        world.motorWork(), world.dragWork(), world.dragImpulse());
    if (figures.knockOuts > 0)
        text += fmt::format("  knocked out        {:7} times, {} limp now\n", figures.knockOuts, figures.limp);
    if (cast.settings().getUp) {
        const GetUpFigures up = cast.getUpFigures();
        if (up.begun == 0) return text + "  got up                   0 times begun\n";
        text += fmt::format("  got up             {:7} of {} times", up.stood, up.begun);
        if (up.stood > 0) text += fmt::format(", in {:.2f} s, {:.2f} s at most", up.meanSeconds, up.mostSeconds);
        text += fmt::format("\n  on the way         {:7.1f} deg in a step at most{}, feet slid {:.1f} cm\n",
                            up.mostStepDeg, at(up.stepJoint), up.mostSlideM * 1e2F);
    }
    return text;
}

}  // namespace lutka::scene
