#pragma once

#include "command_line.hpp"

/// One function a command: adds its options to `app` and a callback that runs it. A callback ends by exitWith().
namespace lutka::cli {

void addExport(const Command& app);
void addInspect(const Command& app);
void addMap(const Command& app);
void addBuild(const Command& app);
void addCheck(const Command& app);
void addReport(const Command& app);
void addScene(const Command& app);
void addSimulate(const Command& app);
void addRender(const Command& app);
void addRetarget(const Command& app);
void addEdit(const Command& app);
void addBench(const Command& app);
void addBatch(const Command& app);

}  // namespace lutka::cli
