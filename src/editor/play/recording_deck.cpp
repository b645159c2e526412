#include "editor/play/recording_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lutka::editor {
namespace {

using scene::Recording;

Take::Cast castOf(const scene::Simulation& simulation) {
    const scene::Scenario& scenario = simulation.scenario();
    return {scenario.dollEntities, scenario.propEntities, scenario.props.size() - scenario.propEntities.size()};
}

int bodiesOf(const Recording& recording, int doll) {
    return recording.bodiesOfDoll.empty() ? recording.bodiesPerDoll
                                          : recording.bodiesOfDoll[static_cast<std::size_t>(doll)];
}

// Where a doll's bodies begin in a frame; for `doll` == dolls: where the props do.
std::size_t firstBodyOf(const Recording& recording, int doll) {
    std::size_t first = 0;
    for (int one = 0; one < doll; ++one)
        first += static_cast<std::size_t>(bodiesOf(recording, one));
    return first;
}

// Of each in `now`, its place in `then`; -1: it was not there.
std::vector<int> placesIn(const std::vector<scene::EntityId>& then, const std::vector<scene::EntityId>& now) {
    std::vector<int> places;
    for (const scene::EntityId id : now) {
        const auto at = std::find(then.begin(), then.end(), id);
        places.push_back(at != then.end() ? static_cast<int>(at - then.begin()) : -1);
    }
    return places;
}

// Balls are told apart by the order in which they were thrown.
void addThrown(std::size_t then, std::size_t now, std::size_t firstThen, std::vector<int>& places) {
    for (std::size_t ball = 0; ball < now; ++ball)
        places.push_back(ball < then ? static_cast<int>(firstThen + ball) : -1);
}

int sinceOf(const std::vector<int>& since, int item) {
    return since.empty() ? 0 : since[static_cast<std::size_t>(item)];
}

// Of all in a new order, when they came in; who is new comes in at `step`.
std::vector<int> sinceIn(const std::vector<int>& since, const std::vector<int>& places, int step) {
    std::vector<int> all;
    all.reserve(places.size());
    for (const int place : places)
        all.push_back(place >= 0 ? sinceOf(since, place) : step);
    return all;
}

bool allKept(std::size_t count, const std::vector<int>& places) {
    return static_cast<std::size_t>(std::count_if(places.begin(), places.end(), [](int at) { return at >= 0; })) ==
           count;
}

}  // namespace

double Take::seconds() const {
    return std::max(recording.steps() - 1, 0) * static_cast<double>(recording.dt);
}

void RecordingDeck::start(scene::Simulation& simulation) {
    LUTKA_ASSERT(!replaying_);
    stop();
    Take& take = takes_.emplace_back();
    take.name = fmt::format("Take {}", ++numbered_);
    take.recording = scene::beginRecording(simulation);
    take.cast = castOf(simulation);
    scene::record(simulation, take.recording);
    current_ = static_cast<int>(takes_.size()) - 1;
    recordingOn_ = true;
}

// Makes a take's frames as long as the simulation's: who is new gets a place in all of them. Whether that can be done:
// nobody has gone, and all have the bodies that they had.
bool RecordingDeck::fitInto(Take& take, const scene::Simulation& simulation) const {
    const Recording old = take.recording;
    Recording next = scene::beginRecording(simulation);
    const Take::Cast now = castOf(simulation);
    const std::vector<int> dolls = placesIn(take.cast.dolls, now.dolls);
    std::vector<int> props = placesIn(take.cast.props, now.props);
    addThrown(take.cast.thrown, now.thrown, take.cast.props.size(), props);
    const std::size_t oldProps = take.cast.props.size() + take.cast.thrown;
    if (next.model != old.model || next.dt != old.dt || !allKept(take.cast.dolls.size(), dolls) ||
        !allKept(oldProps, props)) {
        return false;
    }
    for (std::size_t doll = 0; doll < dolls.size(); ++doll) {
        const int bodies = bodiesOf(next, static_cast<int>(doll));
        if (dolls[doll] >= 0 && bodies != bodiesOf(old, dolls[doll])) return false;
    }
    const std::size_t size = next.frameSize();
    next.frames.resize(size * static_cast<std::size_t>(old.steps()));
    for (int step = 0; step < old.steps(); ++step) {
        const auto from = old.frame(step);
        const auto to = std::span(next.frames).subspan(size * static_cast<std::size_t>(step), size);
        for (std::size_t doll = 0; doll < dolls.size(); ++doll) {
            if (dolls[doll] < 0) continue;
            const auto bodies = static_cast<std::size_t>(bodiesOf(old, dolls[doll]));
            const auto first = from.subspan(firstBodyOf(old, dolls[doll]), bodies);
            std::copy(first.begin(), first.end(), to.begin() + firstBodyOf(next, static_cast<int>(doll)));
        }
        for (std::size_t prop = 0; prop < props.size(); ++prop) {
            if (props[prop] >= 0)
                to[firstBodyOf(next, next.dolls) + prop] = from[firstBodyOf(old, old.dolls) + props[prop]];
        }
    }
    take.dollSince = sinceIn(take.dollSince, dolls, old.steps());
    take.propSince = sinceIn(take.propSince, props, old.steps());
    take.recording = std::move(next);
    take.cast = now;
    return true;
}

void RecordingDeck::keepStep(scene::Simulation& simulation) {
    if (!recordingOn_) return;
    Take& take = takes_[current_];
    const Take::Cast now = castOf(simulation);
    const Recording present = scene::beginRecording(simulation);
    const bool same = now.dolls == take.cast.dolls && now.props == take.cast.props && now.thrown == take.cast.thrown &&
                      present.frameSize() == take.recording.frameSize() &&
                      present.bodiesOfDoll == take.recording.bodiesOfDoll && present.dt == take.recording.dt;
    if (!same && !fitInto(take, simulation)) return stop("what it records is no longer the same");
    if (take.recording.steps() >= kMostSteps) return stop("it is ten minutes long");
    scene::record(simulation, take.recording);
    if (same || take.recording.steps() < 2) return;
    // Who has just come in waits where it came in.
    const std::size_t size = take.recording.frameSize();
    const int last = take.recording.steps() - 1;
    auto& frames = take.recording.frames;
    const auto fill = [&](std::size_t first, std::size_t count) {
        for (int step = 0; step < last; ++step)
            std::copy_n(frames.begin() + static_cast<std::ptrdiff_t>(size * last + first), count,
                        frames.begin() + static_cast<std::ptrdiff_t>(size * step + first));
    };
    for (int doll = 0; doll < take.recording.dolls; ++doll) {
        if (sinceOf(take.dollSince, doll) == last)
            fill(firstBodyOf(take.recording, doll), static_cast<std::size_t>(bodiesOf(take.recording, doll)));
    }
    for (int prop = 0; prop < take.recording.props; ++prop) {
        if (sinceOf(take.propSince, prop) == last) fill(firstBodyOf(take.recording, take.recording.dolls) + prop, 1);
    }
}

void RecordingDeck::stop(const std::string& why) {
    if (recordingOn_ && !why.empty())
        news_ = fmt::format("{} ({:.1f} s) ended: {}. It is kept under Physics", takes_[current_].name, seconds(), why);
    recordingOn_ = false;
}

void RecordingDeck::choose(int take) {
    LUTKA_ASSERT(take >= 0 && take < static_cast<int>(takes_.size()));
    if (!recordingOn_ && !replaying_) current_ = take;
}

void RecordingDeck::rename(int take, std::string name) {
    if (!name.empty()) takes_[take].name = std::move(name);
}

void RecordingDeck::remove(int take) {
    if (recordingOn_ || replaying_) return;
    takes_.erase(takes_.begin() + take);
    current_ = std::min(current_, static_cast<int>(takes_.size()) - 1);
}

bool RecordingDeck::anyUnsaved() const {
    return std::any_of(takes_.begin(), takes_.end(), [](const Take& take) { return !take.saved; });
}

// Who of the simulation is who of the take. A take from a file names nobody: there the order counts.
void RecordingDeck::matchParts(const Take& take, const scene::Simulation& simulation) {
    const Take::Cast now = castOf(simulation);
    const Recording present = scene::beginRecording(simulation);
    const Recording& recorded = take.recording;
    dollOfTake_.assign(static_cast<std::size_t>(simulation.dollCount()), -1);
    propOfTake_.assign(simulation.scenario().props.size(), -1);
    if (!take.cast.dolls.empty() && recorded.model != present.model) {
        // Another model's bodies would be nonsense, however many there are.
    } else if (take.cast.dolls.empty()) {
        for (std::size_t doll = 0; doll < dollOfTake_.size() && static_cast<int>(doll) < recorded.dolls; ++doll)
            dollOfTake_[doll] = static_cast<int>(doll);
        for (std::size_t prop = 0; prop < propOfTake_.size() && static_cast<int>(prop) < recorded.props; ++prop)
            propOfTake_[prop] = static_cast<int>(prop);
    } else {
        dollOfTake_ = placesIn(take.cast.dolls, now.dolls);
        propOfTake_ = placesIn(take.cast.props, now.props);
        addThrown(take.cast.thrown, now.thrown, take.cast.props.size(), propOfTake_);
    }
    for (std::size_t doll = 0; doll < dollOfTake_.size(); ++doll) {
        int& place = dollOfTake_[doll];
        if (place >= 0 && bodiesOf(recorded, place) != bodiesOf(present, static_cast<int>(doll))) place = -1;
    }
    const auto found = [](const std::vector<int>& places) {
        return static_cast<int>(std::count_if(places.begin(), places.end(), [](int place) { return place >= 0; }));
    };
    missing_ = recorded.dolls + recorded.props - found(dollOfTake_) - found(propOfTake_);
}

Result<void> RecordingDeck::replay(scene::Simulation& simulation) {
    if (steps() == 0) return Error{ErrorCode::usage, "there is no recording to replay", "", "record first"};
    const Take& take = takes_[current_];
    matchParts(take, simulation);
    // The same model with none or some of its companions is shown; another one would be nonsense.
    const bool nobody = std::none_of(dollOfTake_.begin(), dollOfTake_.end(), [](int doll) { return doll >= 0; });
    if (nobody) {
        const Recording present = scene::beginRecording(simulation);
        return Error{ErrorCode::usage,
                     fmt::format("{} has {} dolls of {} bodies of {}, the scene {} of {} bodies of {}", take.name,
                                 take.recording.dolls, take.recording.bodiesPerDoll, take.recording.model,
                                 present.dolls, present.bodiesPerDoll, present.model),
                     "", "open the scene and model that it was recorded with"};
    }
    stop("it is shown now");
    news_.clear();
    replaying_ = true;
    scrubTo(0.0, simulation);
    return {};
}

void RecordingDeck::endReplay(scene::Simulation& simulation) {
    replaying_ = false;
    simulation.leaveOut({}, {});
}

void RecordingDeck::showNextStep(scene::Simulation& simulation) {
    if (replaying_) scrubTo(position_ + static_cast<double>(takes_[current_].recording.dt), simulation);
}

void RecordingDeck::scrubTo(double seconds, scene::Simulation& simulation) {
    if (!replaying_) return;
    const Take& take = takes_[current_];
    const Recording& recording = take.recording;
    const auto dt = static_cast<double>(recording.dt);
    position_ = std::clamp(seconds, 0.0, this->seconds());
    const int last = steps() - 1;
    const int before = std::min(static_cast<int>(std::floor(position_ / dt + 1e-6)), last);
    const int after = std::min(before + 1, last);
    const auto share = static_cast<float>(std::clamp(position_ / dt - before, 0.0, 1.0));
    const auto a = recording.frame(before);
    const auto b = recording.frame(after);
    shown_.clear();
    std::vector<bool> noDoll;
    std::vector<bool> noProp;
    const auto add = [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i)
            shown_.push_back(interpolate(a[i], b[i], share));
    };
    for (int doll = 0; doll < simulation.dollCount(); ++doll) {
        const int place = dollOfTake_[static_cast<std::size_t>(doll)];
        const std::size_t bodies = simulation.assetOf(doll).profile.bodies.size();
        noDoll.push_back(place < 0 || sinceOf(take.dollSince, place) > before);
        if (place < 0) {
            shown_.resize(shown_.size() + bodies);
        } else {
            add(firstBodyOf(recording, place), bodies);
        }
    }
    for (const int place : propOfTake_) {
        noProp.push_back(place < 0 || sinceOf(take.propSince, place) > before);
        if (place < 0) {
            shown_.emplace_back();
        } else {
            add(firstBodyOf(recording, recording.dolls) + static_cast<std::size_t>(place), 1);
        }
    }
    simulation.leaveOut(std::move(noDoll), std::move(noProp));
    simulation.preview(shown_);
}

Result<void> RecordingDeck::save(const std::filesystem::path& file) const {
    if (steps() == 0) return Error{ErrorCode::usage, "there is no recording to save", "", "record first"};
    return scene::saveRecording(file, takes_[current_].recording);
}

void RecordingDeck::markSaved() {
    if (current_ >= 0) takes_[current_].saved = true;
}

Result<void> RecordingDeck::open(const std::filesystem::path& file, scene::Simulation& simulation) {
    auto opened = scene::loadRecording(file);
    if (!opened) return opened.error();
    stop("another one was opened");
    const int before = current_;
    Take& take = takes_.emplace_back();
    take.name = file.stem().string();
    take.recording = std::move(opened).value();
    take.saved = true;
    current_ = static_cast<int>(takes_.size()) - 1;
    auto shown = replay(simulation);
    if (!shown) {
        takes_.pop_back();
        current_ = before;
    }
    return shown;
}

}  // namespace lutka::editor
