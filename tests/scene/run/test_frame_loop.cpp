#include "scene/run/frame_loop.hpp"

#include <limits>
#include <vector>

#include "support/catch.hpp"

using namespace lutka;
using scene::FrameLoop;

namespace {

// A machine on which a step and a picture take as long as it says.
struct Machine {
    double now = 0.0;
    double stepSeconds = 0.0;
    double pictureSeconds = 0.0;
    int steps = 0;

    [[nodiscard]] FrameLoop loop(scene::FrameLoopSettings settings = {}) {
        return FrameLoop(settings, [this] { return now; });
    }
    // Frames until `seconds` have passed, each as long as its steps and its picture took; the steps of each.
    std::vector<int> run(FrameLoop& loop, double seconds) {
        std::vector<int> stepsOfFrames;
        double frame = pictureSeconds;
        for (const double end = now + seconds; now < end;) {
            const double began = now;
            stepsOfFrames.push_back(loop.advance(frame, [&] {
                now += stepSeconds;
                ++steps;
            }));
            now += pictureSeconds;
            frame = now - began;
        }
        return stepsOfFrames;
    }
};

constexpr double kFrameSeconds = 1.0 / 60.0;

}  // namespace

TEST_CASE("frames of a step's length give one step each and show the newest state but one") {
    FrameLoop loop;
    int steps = 0;
    for (int frame = 0; frame < 600; ++frame)
        CHECK(loop.advance(kFrameSeconds, [&] { ++steps; }) == 1);
    CHECK(steps == 600);
    CHECK(loop.alpha() == Approx(0.0F).margin(1e-6));
    CHECK(loop.keepsUp());
}

TEST_CASE("the simulation's clock does not depend on the drawing's") {
    for (const double hz : {24.0, 59.0, 60.0, 144.0, 1000.0}) {
        FrameLoop loop;
        int steps = 0;
        const int frames = static_cast<int>(hz * 10.0);
        for (int frame = 0; frame < frames; ++frame) {
            loop.advance(1.0 / hz, [&] { ++steps; });
            // What is drawn lies one step behind the clock, at every moment.
            const double drawn = (steps - 1 + static_cast<double>(loop.alpha())) * kFrameSeconds;
            CHECK(drawn == Approx((frame + 1) / hz - kFrameSeconds).margin(1e-6));
        }
        INFO(hz);
        CHECK(std::abs(steps - 600) <= 1);
        CHECK(loop.achievedSpeed() == Approx(1.0));
    }
}

TEST_CASE("slow motion takes fewer steps, not shorter ones, and is not called late") {
    FrameLoop loop;
    loop.setSpeed(0.25);
    int steps = 0;
    for (int frame = 0; frame < 400; ++frame)
        loop.advance(kFrameSeconds, [&] { ++steps; });
    CHECK(steps == 100);
    CHECK(loop.achievedSpeed() == Approx(0.25));
    CHECK(loop.keepsUp());
}

TEST_CASE("a machine that keeps up runs at full speed though each step costs") {
    Machine machine{0.0, 0.006, 0.006, 0};
    FrameLoop loop = machine.loop();
    machine.run(loop, 5.0);
    CHECK(machine.steps == Approx(300).margin(3));
    CHECK(loop.keepsUp());
    CHECK(loop.load() == Approx(0.36).margin(0.01));
    CHECK(loop.stepCost() == Approx(0.006));
}

TEST_CASE("a machine that cannot keep up slows the simulation down evenly and the loop says by how much") {
    Machine machine{0.0, 0.030, 0.005, 0};  // a step takes nearly twice its own time
    FrameLoop loop = machine.loop();
    machine.run(loop, 2.0);
    const int before = machine.steps;
    const std::vector<int> steps = machine.run(loop, 7.0);
    // One step and one picture in turn: no frame grows, and none moves more than another.
    for (const int one : steps)
        CHECK(one == 1);
    CHECK(steps.size() == Approx(200).margin(2));
    CHECK(loop.alpha() == 1.0F);
    const double speed = (machine.steps - before) * kFrameSeconds / 7.0;
    CHECK(speed == Approx(kFrameSeconds / 0.035).margin(0.01));
    CHECK(loop.achievedSpeed() == Approx(speed).margin(0.01));
    CHECK_FALSE(loop.keepsUp());
    CHECK(loop.load() > 1.5);
}

TEST_CASE("cheap steps under an expensive picture still run at full speed") {
    Machine machine{0.0, 0.004, 0.050, 0};
    FrameLoop loop = machine.loop();
    machine.run(loop, 6.0);
    CHECK(machine.steps == Approx(360).margin(6));
    CHECK(loop.keepsUp());
}

TEST_CASE("the loop comes back to full speed when the machine does") {
    Machine machine{0.0, 0.030, 0.005, 0};
    FrameLoop loop = machine.loop();
    machine.run(loop, 2.0);
    REQUIRE_FALSE(loop.keepsUp());
    machine.stepSeconds = 0.002;
    machine.run(loop, 4.0);
    CHECK(loop.keepsUp());
    const int before = machine.steps;
    machine.run(loop, 3.0);
    CHECK(machine.steps - before == Approx(180).margin(2));
}

TEST_CASE("a halt is not caught up with") {
    FrameLoop loop;
    int steps = 0;
    CHECK(loop.advance(5.0, [&] { ++steps; }) == 6);  // 0.1 s
    CHECK_FALSE(loop.keepsUp());
    CHECK(loop.share() == Approx(0.02));
}

TEST_CASE("a frame time that is no time counts as none") {
    FrameLoop loop;
    int steps = 0;
    for (const double seconds : {-1.0, std::numeric_limits<double>::quiet_NaN(), 0.0})
        CHECK(loop.advance(seconds, [&] { ++steps; }) == 0);
    CHECK(steps == 0);
    CHECK(loop.share() == 1.0);
    CHECK(std::isfinite(loop.achievedSpeed()));
}

TEST_CASE("a restarted loop shows the present state and owes nothing") {
    FrameLoop loop;
    loop.advance(1.9 * kFrameSeconds, [] {});
    CHECK(loop.alpha() == Approx(0.9F));
    loop.restart();
    CHECK(loop.alpha() == 1.0F);
    CHECK(loop.advance(0.5 * kFrameSeconds, [] {}) == 0);
}
