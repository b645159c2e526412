#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lutka::cli {

/// An option that was just added, to say what else holds for it. A handle: copies are the same option.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    Option required(bool yes = true) const;
    Option describe(const std::string& help) const;
    /// A whole number in [low, high].
    Option range(int low, int high) const;
    /// A finite number in [low, high].
    Option range(double low, double high) const;
    /// One of these words.
    Option oneOf(const std::vector<std::string>& words, bool ignoreCase = false) const;
    /// `problem` gives what is wrong with the text, or nothing.
    Option check(std::function<std::string(const std::string&)> problem) const;
    /// Several values in one word, separated by commas, with or without blanks around them; exactly `count` when that
    /// is above 0.
    Option commaSeparated(int count = 0) const;
    /// One value each time the option is given, of any number of times.
    Option oneValueEach() const;
    /// Only together with the other.
    Option needs(const Option& other) const;
    /// Never together with the other.
    Option excludes(const Option& other) const;
    /// The help shows the value that the variable has now.
    Option showDefault() const;

  private:
    CLI::Option* option_;
};

/// A command of the command line. A handle: copies are the same command.
class Command {
  public:
    explicit Command(CLI::App* app) : app_(app) {}

    /// A command below this one.
    [[nodiscard]] Command add(const std::string& name, const std::string& help) const;
    /// Names like "-o,--output", or "MODEL" for a positional one; `value` takes what was given and must outlive the
    /// parse. T: std::string, std::filesystem::path, int, float, double, std::uint64_t, an std::optional of one of
    /// these, or an std::vector of strings, ints or floats.
    template <class T>
    Option option(const std::string& names, T& value, const std::string& help) const;
    Option flag(const std::string& names, bool& value, const std::string& help) const;
    /// The option of that name, added before.
    [[nodiscard]] Option find(const std::string& name) const;
    /// What happens when the command was given and all of its options were read.
    void onRun(std::function<void()> run) const;

  private:
    CLI::App* app_;
};

/// What the program says of itself.
struct ProgramFacts {
    std::function<std::string()> version;  ///< Asked only when it is to be printed.
    std::string licenses;                  ///< A line a part.
    std::string footer;                    ///< Of the help.
    std::function<void()> onQuiet;         ///< --quiet was given; called before the command runs.
    std::function<void()> onVerbose;       ///< --verbose.
};

/// Builds the commands with `addCommands`, reads the arguments and runs what they ask for. Returns the exit code: 0,
/// also after --help, --version and --licenses, or that of wrong usage. What the command throws goes on to the caller.
///
/// CLI11 stays behind this: its header alone costs seven seconds of compiling a file.
int parseCommandLine(int argc, char** argv, const ProgramFacts& facts,
                     const std::function<void(const Command&)>& addCommands);

/// Pieces between commas, without the blanks around them.
[[nodiscard]] std::vector<std::string> splitList(const std::string& text);

}  // namespace lutka::cli
