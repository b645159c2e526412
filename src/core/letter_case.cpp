#include "core/letter_case.hpp"

#include <algorithm>

namespace lutka {

std::string lowerCased(std::string_view text) {
    std::string lower(text);
    for (char& letter : lower)
        letter = lowerCased(letter);
    return lower;
}

bool sameButCase(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lowerCased(x) == lowerCased(y); });
}

}  // namespace lutka
