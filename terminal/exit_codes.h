// The exit codes of all programs: scripts and supervisors go by them.
#pragma once

namespace antipode {

enum ExitCode : int {
    exitDone = 0,
    exitFailed = 1,
    exitUsage = 2,
    exitDeviceLost = 75,  ///< EX_TEMPFAIL of sysexits.h
};

struct ExitCodeInfo {
    ExitCode code;
    const char* meaning;  ///< for help and manual
};

constexpr ExitCodeInfo exitCodes[] = {
    {exitDone,
     "done; also where a signal or a limit of time ended it early and what was rendered is written or fetched"},
    {exitFailed,
     "failed: an input, output or device; refused by all servers for good; no server for as long as --wait says; "
     "interrupted before anything was rendered"},
    {exitUsage, "wrong: the command line, a variable of the environment, or a checkpoint that is another job's"},
    {exitDeviceLost, "antipode-server only: its device was lost, and a new process may find it again"},
};

}  // namespace antipode
