#pragma once

#include <CLI/CLI.hpp>

/// One function a command: adds its options to `app` and a callback that runs it. A callback ends by exitWith().
namespace lutka::cli {

void addInspect(CLI::App& app);
void addMap(CLI::App& app);
void addBuild(CLI::App& app);
void addCheck(CLI::App& app);
void addScene(CLI::App& app);
void addSimulate(CLI::App& app);
void addRender(CLI::App& app);
void addEdit(CLI::App& app);
void addBench(CLI::App& app);

}  // namespace lutka::cli
