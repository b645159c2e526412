#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/assert.hpp"

namespace lutka {

/// What kind of failure an Error is. The numbers are the exit codes of the CLI.
enum class ErrorCode {
    internal = 1,   ///< A defect of ours, or of a library beneath us.
    usage = 2,      ///< The caller asked for something that does not exist or does not fit together.
    input = 3,      ///< A file can't be read or isn't usable (not a humanoid, no skeleton, an invalid profile …).
    findings = 4,   ///< `lutka check` found errors.
    output = 5,     ///< A file can't be written.
    noDisplay = 6,  ///< No display, or no GL context.
};

/// A failure told to a person: what is wrong, where, and what would mend it.
struct Error {
    ErrorCode code = ErrorCode::internal;
    std::string message;   ///< What is wrong, one sentence without a full stop.
    std::string location;  ///< File, and the place in it (line, JSON pointer, joint path); empty where there is none.
    std::string mend;      ///< What the user can do about it; empty where nothing is known.

    /// "location: message (mend)", the parts that exist.
    [[nodiscard]] std::string text() const {
        std::string out = location.empty() ? message : location + ": " + message;
        if (!mend.empty()) out += " (" + mend + ")";
        return out;
    }
};

/// Either a value or an Error. The value is reached only after a check: value() of a failed result is a caller's bug.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] T& value() & {
        LUTKA_ASSERT(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] const T& value() const& {
        LUTKA_ASSERT(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T&& value() && {
        LUTKA_ASSERT(ok());
        return std::move(*std::get_if<0>(&state_));
    }
    [[nodiscard]] const Error& error() const {
        LUTKA_ASSERT(!ok());
        return *std::get_if<1>(&state_);
    }

  private:
    std::variant<T, Error> state_;
};

/// A result without a value: success, or an Error.
template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

    [[nodiscard]] bool ok() const { return !error_.has_value(); }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] const Error& error() const {
        LUTKA_ASSERT(!ok());
        return *error_;
    }

  private:
    std::optional<Error> error_;
};

}  // namespace lutka
