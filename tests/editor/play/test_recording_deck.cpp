#include "editor/play/recording_deck.hpp"

#include <glm/geometric.hpp>

#include "editor/sessions.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;

namespace {

vec3 hipsOf(scene::Simulation& simulation) {
    return simulation.worldFromBody(0)[0].translation;
}

// Records so many steps; where the hips were at each.
std::vector<vec3> recordSteps(RecordingDeck& deck, scene::Simulation& simulation, int steps) {
    deck.start(simulation);
    std::vector<vec3> places{hipsOf(simulation)};
    for (int step = 0; step < steps; ++step) {
        simulation.step();
        deck.keepStep(simulation);
        places.push_back(hipsOf(simulation));
    }
    return places;
}

}  // namespace

TEST_CASE("a deck that kept nothing neither replays nor saves") {
    const auto editor = test::makeEditor();
    const test::ScratchFolder folder;
    RecordingDeck deck;
    CHECK(deck.steps() == 0);
    CHECK(deck.seconds() == 0.0);
    CHECK_FALSE(deck.replay(editor->player().simulation()));
    CHECK_FALSE(deck.replaying());
    CHECK_FALSE(deck.save(folder / "nothing"));
}

TEST_CASE("a deck shows the steps that it kept and means between them") {
    const auto editor = test::makeEditor();
    scene::Simulation& simulation = editor->player().simulation();
    RecordingDeck deck;
    const std::vector<vec3> places = recordSteps(deck, simulation, 20);
    CHECK(deck.recording());
    CHECK(deck.steps() == 21);
    REQUIRE(deck.replay(simulation));
    CHECK_FALSE(deck.recording());  // it never keeps what it shows
    deck.scrubTo(5.5 / 60.0, simulation);
    CHECK(glm::distance(hipsOf(simulation), (places[5] + places[6]) * 0.5F) < 1e-4F);
    deck.showNextStep(simulation);
    CHECK(deck.position() == Approx(6.5 / 60.0));
    deck.scrubTo(100.0, simulation);
    CHECK(deck.atEnd());
    CHECK(glm::distance(hipsOf(simulation), places.back()) < 1e-5F);
}

TEST_CASE("a file that can't be opened leaves what a deck kept") {
    const auto editor = test::makeEditor();
    RecordingDeck deck;
    recordSteps(deck, editor->player().simulation(), 5);
    const test::ScratchFolder folder;
    CHECK_FALSE(deck.open(folder / "nowhere", editor->player().simulation()));
    CHECK(deck.steps() == 6);
}
