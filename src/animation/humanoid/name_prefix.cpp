#include "animation/humanoid/name_prefix.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include "animation/humanoid/name_lexicon.hpp"
#include "animation/humanoid/name_tokens.hpp"

namespace lutka::animation {
namespace {

bool isLetter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool isCapital(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}

// Where a word ends in a name, and letters come later.
bool endsWordAt(std::string_view name, std::size_t place) {
    if (place == 0 || !std::any_of(name.begin() + static_cast<std::ptrdiff_t>(place), name.end(), isLetter))
        return false;
    const bool before = isLetter(name[place - 1]);
    return before && (!isLetter(name[place]) || (isCapital(name[place]) && !isCapital(name[place - 1])));
}

// Whether a rig's own name would be taken for a word about a body.
bool speaks(std::string_view prefix) {
    const NameTokens tokens = tokenise(prefix);
    if (tokens.side != Side::center) return false;
    return std::any_of(tokens.words.begin(), tokens.words.end(), [](const std::string& word) {
        const auto meaning = conceptOf(word);
        // A prefix of controls says something: what it stands before is driven.
        return meaning && *meaning != Concept::noise && *meaning != Concept::control;
    });
}

}  // namespace

std::string figureName(std::span<const std::string> names) {
    constexpr std::size_t kFewest = 8;
    constexpr std::size_t kLongest = 48;  // letters
    std::map<std::string_view, std::size_t> counts;
    for (const std::string& name : names) {
        for (std::size_t place = 1; place < std::min(name.size(), kLongest); ++place)
            if (endsWordAt(name, place)) ++counts[std::string_view(name).substr(0, place)];
    }
    std::string_view longest;
    for (const auto& [prefix, count] : counts) {
        const bool isCommon = count >= kFewest && count * 5 >= names.size() * 4;
        if (isCommon && prefix.size() > longest.size()) longest = prefix;
    }
    return speaks(longest) ? std::string(longest) : std::string();
}

}  // namespace lutka::animation
