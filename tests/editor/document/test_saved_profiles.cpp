#include "editor/document/saved_profiles.hpp"

#include <fstream>

#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;

TEST_CASE("a fit has no file and differs from anything but itself") {
    SavedProfiles saved;
    saved.begin("fit");
    CHECK_FALSE(saved.fileOf({}).has_value());
    CHECK_FALSE(saved.differs({}, "fit"));
    CHECK(saved.differs({}, "fit with an edit"));
}

TEST_CASE("what was saved is remembered for each base, and one that was never seen differs") {
    SavedProfiles saved;
    saved.begin("fit");
    saved.remember({}, "fit.json", "fit as saved");
    saved.remember("base.json", "base.json", "read");
    CHECK(saved.fileOf({}) == std::filesystem::path("fit.json"));
    CHECK(saved.fileOf("base.json") == std::filesystem::path("base.json"));
    CHECK_FALSE(saved.differs({}, "fit as saved"));
    CHECK_FALSE(saved.differs("base.json", "read"));
    CHECK(saved.differs("base.json", "fit as saved"));
    CHECK(saved.differs("other.json", ""));
}

TEST_CASE("only a file that is there and was neither opened nor written would be replaced") {
    const test::ScratchFolder folder;
    SavedProfiles saved;
    saved.begin("fit");
    CHECK_FALSE(saved.wouldReplace(folder / "new.json"));
    std::ofstream(folder / "theirs.json") << "{}";
    CHECK(saved.wouldReplace(folder / "theirs.json"));
    saved.remember({}, folder / "theirs.json", "fit");
    CHECK_FALSE(saved.wouldReplace(folder / "theirs.json"));
}
