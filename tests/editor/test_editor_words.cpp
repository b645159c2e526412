#include "editor/editor_words.hpp"

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "editor/sessions.hpp"

using namespace lutka;
using namespace lutka::editor;
namespace fs = std::filesystem;

namespace {

// What no window ever shows: other programs' words, and those of commands alone.
bool isForTerminals(const std::string& fileInSources) {
    for (const char* part : {"editor/", "report/", "scene/batch/", "scene/measure/", "scene/run/load_shedding",
                             "render/gl/gl_context", "scene/draw/debug_layers", "scene/asset/load_words"}) {
        if (fileInSources.rfind(part, 0) == 0) return true;
    }
    return false;
}

std::string withoutComments(const fs::path& file) {
    std::ifstream in(file);
    std::string text;
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first != std::string::npos && line.compare(first, 2, "//") == 0) continue;
        text += line + "\n";
    }
    return text;
}

// The string literals of a source, those that stand side by side as one.
std::vector<std::string> literalsOf(const fs::path& file) {
    static const std::regex kJoint("\"\\s*\n\\s*\"");
    static const std::regex kLiteral("\"((?:[^\"\\\\\n]|\\\\.)*)\"");
    const std::string text = std::regex_replace(withoutComments(file), kJoint, "");
    std::vector<std::string> all;
    for (std::sregex_iterator at(text.begin(), text.end(), kLiteral), end; at != end; ++at)
        all.push_back(std::regex_replace((*at)[1].str(), std::regex("\\\\\""), "\""));
    return all;
}

// Options that `lutka edit` itself has may be named as such, and are then what to start it with.
std::string withoutOwnOptions(std::string text) {
    return std::regex_replace(text, std::regex("`lutka edit --[a-z-]+`"), "");
}

}  // namespace

TEST_CASE("no message of the libraries tells the editor's user of commands and options of the command line") {
    // As a word of a sentence: alone it is the place of an error that only the command line makes.
    const std::regex ofTerminal("(`lutka |--[a-z])");
    int told = 0;
    const fs::path sources(LUTKA_TESTS_DIR "/../src");
    for (const auto& entry : fs::recursive_directory_iterator(sources)) {
        const fs::path ending = entry.path().extension();
        const bool isSource = ending == ".cpp" || ending == ".hpp";
        if (!isSource || isForTerminals(entry.path().lexically_relative(sources).generic_string())) continue;
        for (const std::string& literal : literalsOf(entry.path())) {
            const bool isSentence = literal.find(' ') != std::string::npos;
            if (!isSentence || !std::regex_search(literal, ofTerminal)) continue;
            ++told;
            INFO(entry.path().string() << ": " << literal);
            CHECK_FALSE(std::regex_search(withoutOwnOptions(inEditorWords(literal)), ofTerminal));
        }
    }
    CHECK(told > 10);  // there is something to look at
}

TEST_CASE("what the editor tells names buttons and menus, in the log as in messages over the view") {
    const auto editor = test::makeEditor();
    const std::string words = "the file holds 1 more character(s), which were left out: Bob (--figure 2)";
    editor->workspace().say(Toast::Kind::warning, words);
    CHECK(editor->workspace().toasts.back().text ==
          "the file holds 1 more character(s), which were left out: Bob (File > Figure of the file, number 2)");
    editor->workspace().note(Toast::Kind::warning, "1 picture was not found: a.png; --allow-outside looks into ../t");
    CHECK_THAT(editor->workspace().log.back().text, Catch::Contains("(File menu) looks into ../t"));
    CHECK(inEditorWords("a name with --dashes of a file") == "a name with --dashes of a file");
}
