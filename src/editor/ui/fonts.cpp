#include "editor/ui/fonts.hpp"

#include <imgui.h>

#include <filesystem>
#include <initializer_list>
#include <string>

namespace lutka::editor {
namespace {

constexpr float kTextSize = 15.0F;
constexpr float kHeadingSize = 18.0F;
constexpr float kMonoSize = 13.0F;

// Kept for good: Dear ImGui reads the ranges when it builds the atlas.
constexpr ImWchar kEuropean[] = {
    0x0020, 0x024F,  // Latin with its accents
    0x0370, 0x052F,  // Greek, Cyrillic
    0x1E00, 0x1EFF,  // more accents
    0x2010, 0x2046,  // dashes, quotes, bullets, ellipsis
    0x2190, 0x21FF,  // arrows
    0x2200, 0x22FF,  // signs of mathematics
    0x25A0, 0x25FF,  // geometric shapes
    0,
};

std::string firstFile(std::initializer_list<const char*> candidates) {
    for (const char* candidate : candidates) {
        if (std::filesystem::exists(candidate)) return candidate;
    }
    return {};
}

std::string japaneseFile() {
    return firstFile({
        "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/opentype/ipafont-gothic/ipag.ttf",
        "/usr/share/fonts/truetype/fonts-japanese-gothic.ttf",
        "/usr/share/fonts/truetype/vlgothic/VL-Gothic-Regular.ttf",
        "/usr/share/fonts/truetype/takao-gothic/TakaoGothic.ttf",
        "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
    });
}

ImFont* load(const std::string& file, float size, const std::string& japanese) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFontConfig config;
    config.OversampleH = 2;
    config.OversampleV = 1;
    ImFont* font = nullptr;
    if (file.empty()) {
        config.SizePixels = size;
        font = atlas.AddFontDefault(&config);
    } else {
        font = atlas.AddFontFromFileTTF(file.c_str(), size, &config, kEuropean);
    }
    if (!japanese.empty()) {
        config.MergeMode = true;
        config.OversampleH = 1;  // thousands of characters
        atlas.AddFontFromFileTTF(japanese.c_str(), size, &config, atlas.GetGlyphRangesJapanese());
    }
    return font;
}

}  // namespace

UiFonts loadFonts(float scale) {
    const std::string sans = firstFile(
        {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"});
    const std::string bold = firstFile(
        {"/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf", "/usr/share/fonts/truetype/noto/NotoSans-Bold.ttf"});
    const std::string mono = firstFile({"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
                                        "/usr/share/fonts/truetype/noto/NotoSansMono-Regular.ttf"});
    const std::string japanese = japaneseFile();
    UiFonts fonts;
    fonts.text = load(sans, kTextSize * scale, japanese);
    fonts.heading = load(bold, kHeadingSize * scale, "");
    fonts.mono = load(mono, kMonoSize * scale, "");
    fonts.japanese = !japanese.empty();
    return fonts;
}

}  // namespace lutka::editor
