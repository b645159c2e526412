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
    settings.uiScale = 1.5F;
    settings.leftWidth = 420.0F;
    settings.remember(folder.path / "hero.glb");
    saveUserSettings(file, settings);
    CHECK(loadUserSettings(file).allowOutside);
    CHECK(loadUserSettings(file).recent == settings.recent);
    CHECK(loadUserSettings(file).uiScale == 1.5F);
    CHECK(loadUserSettings(file).leftWidth == 420.0F);
    CHECK(loadUserSettings(file).rightWidth == 0.0F);
    for (const char* text : {"{", "[1]", R"({"allowOutside": "yes", "recent": 3, "uiScale": 99})"}) {
        INFO(text);
        std::ofstream(file) << text;
        CHECK_FALSE(loadUserSettings(file).allowOutside);
        CHECK(loadUserSettings(file).recent.empty());
        CHECK(loadUserSettings(file).uiScale == 0.0F);
    }
}
