#pragma once

/// Scripts that the shipped program plays, and what comes of them.

#include <cstdlib>
#include <filesystem>
#include <string>

#include "editor/input/input_script.hpp"
#include "editor/sessions.hpp"
#include "physics/profile/profile_io.hpp"
#include "render/gl/golden.hpp"
#include "render/image.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

namespace lutka::test {

namespace fs = std::filesystem;

// A copy of the mannequin in a folder of its own, so that what is saved lands there.
class Scratch {
  public:
    Scratch() { fs::copy_file(LUTKA_ASSETS_DIR "/models/mannequin.glb", model()); }

    [[nodiscard]] fs::path model() const { return folder_.path / "mannequin.glb"; }
    [[nodiscard]] fs::path operator/(const char* name) const { return folder_.path / name; }

  private:
    ScratchFolder folder_;
};

struct Outcome {
    int code = -1;
    std::string output;
};

inline Outcome run(const Scratch& scratch, const std::string& command) {
    const fs::path log = scratch / "log.txt";
    const int status = std::system((command + " >" + log.string() + " 2>&1").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, fileText(log)};
}

inline Outcome edit(const Scratch& scratch, const std::string& arguments) {
    return run(scratch, std::string(LUTKA_BINARY) + " edit " + scratch.model().string() + " " + arguments);
}

// Places in a 1280 × 720 window follow from the fonts that the layout was made with.
inline bool layoutIsKnown() {
    return fs::exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf");
}

/// Writes a script step by step; each call takes its frames.
class Script {
  public:
    Script& move(float x, float y) { return add(editor::mouseMoved({x, y})); }
    Script& press() { return add(editor::mouseButton(editor::MouseButton::left, true)); }
    Script& release() { return add(editor::mouseButton(editor::MouseButton::left, false)); }
    Script& key(editor::Key key, editor::Modifiers modifiers = {}) {
        return add(editor::keyPressed(key, modifiers)).add(editor::keyReleased(key));
    }
    Script& click(float x, float y) { return move(x, y).press().release(); }
    Script& drag(float x, float y, float toX, float toY) {
        move(x, y).press();
        constexpr int steps = 6;
        for (int i = 1; i <= steps; ++i) {
            const float share = static_cast<float>(i) / steps;
            move(x + (toX - x) * share, y + (toY - y) * share);
        }
        return *this;
    }
    Script& add(const editor::InputEvent& event) {
        script_.entries.push_back({frame_, event});
        if (!atOnce_) ++frame_;
        return *this;
    }
    Script& wait(int frames) {
        frame_ += frames;
        return *this;
    }
    // What follows comes in one frame, as on a machine that draws once in a while, until leisurely() is called.
    Script& atOnce() {
        atOnce_ = true;
        return *this;
    }
    Script& leisurely() {
        atOnce_ = false;
        return wait(1);
    }
    void setSize(render::Extent size) { script_.size = size; }
    [[nodiscard]] int frame() const { return frame_; }
    void save(const fs::path& file) const { REQUIRE(editor::saveScript(file, script_).ok()); }

  private:
    editor::InputScript script_;
    int frame_ = 1;
    bool atOnce_ = false;
};

// Plays it without a window; what it saves lies beside the scratch model.
inline Outcome play(const Scratch& scratch, const Script& script, const std::string& more = "") {
    script.save(scratch / "script.jsonl");
    return edit(scratch, "--headless --input " + (scratch / "script.jsonl").string() + more);
}

inline physics::RagdollProfile fitted(const Scratch& scratch) {
    return scene::loadRagdoll(scratch.model()).value()->profile;
}

inline physics::RagdollProfile saved(const Scratch& scratch) {
    auto profile = physics::loadProfile(scratch / "mannequin.ragdoll.json");
    REQUIRE(profile.ok());
    return std::move(profile).value();
}

inline editor::InputEvent rightButton(bool pressed) {
    return editor::mouseButton(editor::MouseButton::right, pressed);
}

inline Script& rightClick(Script& script, float x, float y) {
    return script.move(x, y).add(rightButton(true)).add(rightButton(false));
}

inline Script& type(Script& script, const std::string& text) {
    for (const char letter : text)
        script.add(editor::textTyped(static_cast<std::uint32_t>(letter)));
    return script;
}

inline render::Image cropped(const render::Image& image, int x, int y, int width, int height) {
    render::Image part({width, height}, {});
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column)
            part.set(column, row, image.at(x + column, y + row));
    }
    return part;
}

/// Pictures of a script, taken when the mouse is out of the way.
struct Pictures {
    const Scratch& scratch;
    Script& script;
    std::string arguments;
    vec2 aside{420, 640};

    void take(const char* name) {
        script.move(aside.x, aside.y).wait(4);
        arguments += " --screenshot-at " + std::to_string(script.frame()) + ":" + (scratch / name).string();
        script.wait(1);
    }
    [[nodiscard]] render::Image load(const char* name) const {
        auto picture = render::loadPng(scratch / name);
        REQUIRE(picture.ok());
        return std::move(picture).value();
    }
    [[nodiscard]] render::Color at(const char* name, int x, int y) const { return load(name).at(x, y); }
    [[nodiscard]] float apart(const char* a, const char* b, int x, int y, int width, int height) const {
        constexpr int channel = 16;
        return static_cast<float>(
            render::compareImages(cropped(load(a), x, y, width, height), cropped(load(b), x, y, width, height), channel)
                .differingShare);
    }
};

inline constexpr editor::Modifiers kControl{false, true, false};
// Panels are words: one that changes is a few hundred pixels.
inline constexpr GoldenTolerance kPanel{10, 0.001, 0.5};

}  // namespace lutka::test
