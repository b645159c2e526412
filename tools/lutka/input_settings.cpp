#include "input_settings.hpp"

#include <fmt/format.h>

#include <charconv>
#include <iomanip>
#include <sstream>

namespace lutka::cli {
namespace {

// As words: nothing where the option was not given.
std::string wordOf(const std::string& value) {
    return value;
}
std::string wordOf(bool value) {
    return value ? "yes" : "";
}
std::string wordOf(float value) {
    return fmt::format("{}", value);
}
template <class T>
std::string wordOf(const std::optional<T>& value) {
    return value ? fmt::format("{}", *value) : "";
}
template <class T>
std::string wordOf(const std::vector<T>& values) {
    return fmt::format("{}", fmt::join(values, " "));
}
// Blanks part the words of a list: one that holds any, or a quote, is quoted.
std::string wordOf(const std::vector<std::string>& values) {
    std::ostringstream out;
    for (const std::string& value : values) {
        if (out.tellp() > 0) out << ' ';
        if (value.empty() || value.find_first_of(" \t\n\v\f\r\"") != std::string::npos)
            out << std::quoted(value);
        else
            out << value;
    }
    return out.str();
}

// And back; false where the word is none of its kind.
bool takeWord(const std::string& word, std::string& value) {
    value = word;
    return true;
}
bool takeWord(const std::string& word, bool& value) {
    value = word == "yes";
    return value;
}
template <class T>
bool takeNumber(const std::string& word, T& value) {
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    return failed == std::errc() && end == word.data() + word.size();
}
bool takeWord(const std::string& word, float& value) {
    return takeNumber(word, value);
}
bool takeWord(const std::string& word, std::optional<std::string>& value) {
    value = word;
    return true;
}
template <class T>
bool takeWord(const std::string& word, std::optional<T>& value) {
    return takeNumber(word, value.emplace());
}
template <class T>
bool takeWord(const std::string& words, std::vector<T>& values) {
    values.clear();
    std::istringstream in(words);
    bool good = true;
    for (std::string word; in >> std::ws && !in.eof();) {
        if (!(in >> std::quoted(word))) return false;  // a quote that does not end
        good = takeWord(word, values.emplace_back()) && good;
    }
    return good;
}

// Files of before had one word of names with commas between.
std::vector<std::string> splitAtCommas(const std::vector<std::string>& words) {
    std::vector<std::string> out;
    for (const std::string& word : words) {
        std::istringstream in(word);
        for (std::string name; std::getline(in, name, ',');)
            out.push_back(name);
    }
    return out;
}

// Every setting with its name.
template <class Options, class Visit>
void visitSettings(Options& options, const Visit& visit) {
    visit("scene", options.scene.scene);
    visit("count", options.scene.count);
    visit("seed", options.scene.seed);
    visit("solver", options.scene.solver);
    visit("hold", options.hold);
    visit("pose", options.pose);
    visit("from-clip", options.fromClip);
    visit("clip", options.clip);
    visit("clip-speed", options.clipSpeed);
    visit("once", options.clipOnce);
    visit("in-place", options.clipInPlace);
    visit("puppet", options.puppet);
    visit("strength", options.strength);
    visit("carry-gravity", options.carriesGravity);
    visit("pin", options.pinForceN);
    visit("kinematic", options.kinematic);
    visit("hit", options.hits);
    visit("shed", options.shed);
    visit("eye", options.eye);
}

}  // namespace

std::map<std::string, std::string> inputSettings(const SimulateOptions& options) {
    std::map<std::string, std::string> settings;
    visitSettings(options, [&](const char* name, const auto& value) {
        const std::string word = wordOf(value);
        if (!word.empty()) settings[name] = word;
    });
    return settings;
}

void takeSettings(const std::map<std::string, std::string>& settings, const std::filesystem::path& file,
                  SimulateOptions& options) {
    std::map<std::string, std::string> left = settings;
    visitSettings(options, [&](const char* name, auto& value) {
        const auto found = left.find(name);
        if (found == left.end()) return;
        if (!takeWord(found->second, value)) return;
        left.erase(found);
    });
    options.hold = splitAtCommas(options.hold);
    if (left.empty()) return;
    leave({ErrorCode::input, fmt::format("/settings/{}: is nothing that a run is made of here", left.begin()->first),
           file.string(), "make it anew with `lutka simulate --record`"});
}

}  // namespace lutka::cli
