#include "editor/ui/user_settings.hpp"

#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::editor;

TEST_CASE("what the user chose is there in the next run, and a file that is not understood gives the defaults") {
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder.path / "lutka/editor.json";
    CHECK_FALSE(loadUserSettings(file).allowOutside);
    UserSettings settings;
    settings.allowOutside = true;
    settings.remember(folder.path / "hero.glb");
    saveUserSettings(file, settings);
    CHECK(loadUserSettings(file).allowOutside);
    CHECK(loadUserSettings(file).recent == settings.recent);
    for (const char* text : {"{", "[1]", R"({"allowOutside": "yes", "recent": 3})"}) {
        INFO(text);
        std::ofstream(file) << text;
        CHECK_FALSE(loadUserSettings(file).allowOutside);
        CHECK(loadUserSettings(file).recent.empty());
    }
}
