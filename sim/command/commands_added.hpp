#pragma once
// Each command's arguments and options, which fill in its request.
#include <CLI/CLI.hpp>

#include "sim/command/commands.hpp"

namespace sim {

void add_run(CLI::App& app, RunRequest& request);
void add_trace(CLI::App& app, TraceRequest& request);
void add_find(CLI::App& app, FindRequest& request);
void add_merge(CLI::App& app, MergeRequest& request);
void add_report(CLI::App& app, ReportRequest& request);
void add_diff(CLI::App& app, DiffRequest& request);
void add_encode(CLI::App& app, EncodeRequest& request);
void add_decode(CLI::App& app, DecodeRequest& request);
void add_node(CLI::App& app, NodeRequest& request);
void add_serve(CLI::App& app, ServeRequest& request);
void add_parts(CLI::App& app, PartsRequest& request);
void add_locate(CLI::App& app, LocateRequest& request);
void add_fit(CLI::App& app, FitRequest& request);
void add_check(CLI::App& app, CheckRequest& request);
void add_compare(CLI::App& app, CompareRequest& request);
void add_baseline(CLI::App& app, BaselineRequest& request);
void add_completion(CLI::App& app, CompletionRequest& request);
void add_manual(CLI::App& app);

}  // namespace sim
