/// The Stats tab with times that are given: the only part of the panels that would differ from machine to machine.

#include "editor/application.hpp"
#include "editor/scripts.hpp"

using namespace lutka;
using namespace lutka::editor;
using namespace lutka::test;

namespace {

// A second of frames, one of them late, and steps that grow.
void givenTimes(StatsReadings& readings) {
    readings.history = {};
    for (int frame = 0; frame < 60; ++frame)
        readings.history.add(frame == 40 ? 50.0F : 16.0F + static_cast<float>(frame % 3));
    readings.history.stats.drawCalls = 12;
    readings.history.stats.triangles = 34567;
    readings.stepMs.clear();
    for (int step = 0; step < 90; ++step)
        readings.stepMs.push_back(0.5F + 0.02F * static_cast<float>(step));
    readings.parts = {0.125, 0.25, 1.5, readings.parts.islands};
    readings.poseMs = 0.0625;
    readings.residentBytes = 256.0 * 1024.0 * 1024.0;
}

}  // namespace

TEST_CASE("the Stats tab tells the times that it is given as it did when it was looked at") {
    if (!layoutIsKnown()) SKIP_TEST("the package fonts-dejavu-core is not there");
    const Scratch scratch;
    Script script;
    script.wait(20).key(Key::space).click(1200, 43).move(640, 640).wait(3);
    script.save(scratch / "script.jsonl");
    ApplicationOptions options;
    options.editor.model = scratch.model();
    options.editor.playing = true;
    options.headless = true;
    options.settings = false;
    options.amendStats = givenTimes;
    auto input = loadScript(scratch / "script.jsonl");
    REQUIRE(input.ok());
    options.input = std::move(input).value();
    options.screenshots.push_back({script.frame() - 1, scratch / "stats.png"});
    const auto ran = runApplication(options);
    if (!ran.ok() && ran.error().code == ErrorCode::noDisplay) SKIP_TEST("there is no GL");
    if (!ran.ok()) FAIL(ran.error().text());
    const auto seen = render::loadPng(scratch / "stats.png");
    REQUIRE(seen.ok());
    checkGolden(cropped(seen.value(), 937, 24, 343, 660), "editor_stats", kPanel);
}
