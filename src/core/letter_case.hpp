#pragma once

#include <string>
#include <string_view>

namespace lutka {

/// 'A' to 'Z' made small, whatever the locale; all other bytes as they are.
[[nodiscard]] constexpr char lowerCased(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

/// All of its letters: for names and endings that are compared whatever their case.
[[nodiscard]] std::string lowerCased(std::string_view text);

/// Whether two texts differ in the case of their letters at most.
[[nodiscard]] bool sameButCase(std::string_view a, std::string_view b);

}  // namespace lutka
