// Options of encode, decode, node and serve.
#include "sim/command/command_options.hpp"
#include "sim/command/commands_added.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
void add_encode(CLI::App& app, EncodeRequest& request) {
  auto& encode = *app.add_subcommand(
      "encode", "Print a message as the line carries it: with its checksum and line end");
  encode
      .add_option("MESSAGE", request.message,
                  "the message, without checksum; of sharedlink from its addresses on, the "
                  "receiver's first: "
                  "'AB|N0|D40.1'")
      ->required()
      ->type_name("");
  add_protocol(encode, request.protocol);
  encode.footer("Example: cosys-sim encode 'IND 011111 OK'");
}

void add_decode(CLI::App& app, DecodeRequest& request) {
  auto& decode = *app.add_subcommand(
      "decode",
      "Print the messages in a capture: when, accepted or why not, and their text; and "
      "how well the line keeps to its bit rate. Of several captures a table, a row each");
  add_place(decode, "CAPTURE", request.captures, "",
            "captures of a receiver's output or of its light, or folders of such: .vcd, .sr, .ook, "
            ".csv, .wav, .sigmf-meta, .h5 of trace or .bin")
      ->required();
  add_capture_options(decode, request, "to decode");
  decode
      .add_option(
          "--uart", request.uart,
          "the receiver: atmega (majority of three samples), mid-bit (one), software-serial "
          "(Arduino's) or edge-timing (widths of pulses); atmega if not given")
      ->type_name("NAME")
      ->check(one_of(find_key("uart.receiver")->choices));
  decode
      .add_option_function<std::string>(
          "--baud", [&request](const std::string& text) { request.baud = parse_number(text); },
          "bits per second, 1 to 1000000; if not given or auto, found in the capture")
      ->type_name("RATE")
      ->check(auto_or_between(1, 1e6));
  decode
      .add_option_function<std::string>(
          "--carrier",
          [&request](const std::string& text) { request.carrier_hz = parse_number(text); },
          "of a sampled light or on an LED's wire, or of a baseband its distance from the middle, "
          "in "
          "Hz; 0 for a voltage or wire without; if not given or auto, found in the capture")
      ->type_name("HZ")
      ->check(auto_or_between(0, 1e9));
  decode
      .add_option("--polarity", request.polarity,
                  "idle-high (light is 0) or idle-low; if not given or auto, found in the capture")
      ->type_name("NAME")
      ->check(one_of({"auto", "idle-high", "idle-low"}));
  add_protocol(decode, request.protocol);
  decode.add_flag("--json", request.json,
                  "one JSON object a line for each message, and a last one of the line; of several "
                  "captures one object each");
  decode.footer(
      "What each outcome means: protocol/PROTOCOLS.md. Example: cosys-sim decode trial.vcd --wire "
      "rx");
}

void add_node(CLI::App& app, NodeRequest& request) {
  auto& node = *app.add_subcommand(
      "node", "Be one end of a SharedLink at a serial device: mirror lists, ask and answer");
  add_place(node, "LISTS", request.lists, "", "who the node is, and its lists (.toml)")->required();
  auto* device = add_place(node, "--device", request.device, "DEV",
                           "serial device, or one end of a pseudo-terminal, to talk through");
  add_place(node, "--pty", request.pseudo_terminal, "LINK",
            "make a pseudo-terminal to talk through, and this link for the program at its other "
            "end; it is gone when the node ends")
      ->excludes(device);
  node.add_option("--baud", request.baud, "bits per second; those of LISTS, or 600, if not given")
      ->type_name("RATE")
      ->check(between(1, 1e9));
  node.add_option("--duration", request.duration_s,
                  "end after 90s, 10min or 2h; if not given, at a signal")
      ->type_name("TIME")
      ->transform(a_time());
  node.footer(
      "Reads lines from stdin: Name=value sets a variable, ?Name asks the peer for one. The end of "
      "stdin is not the node's. Prints a JSON line for every event. Example: cosys-sim node "
      "scenarios/nodes/guard.toml --device /dev/ttyUSB0");
}

void add_serve(CLI::App& app, ServeRequest& request) {
  auto& serve = *app.add_subcommand(
      "serve", "Play what a link's receiver hears on a virtual serial port, in real time");
  add_place(serve, "SCENARIO", request.scenario, "", "scenario file (.toml), one point")
      ->required();
  add_place(serve, "--link", request.link, "NAME", "name of the port; ttyCOSYS if not given");
  serve.add_option("--speed", request.settings.speed, "how many times real time; 1 if not given")
      ->type_name("X")
      ->check(between(1e-3, 1e6));
  serve.add_flag("--start-at-once", request.settings.start_at_once,
                 "do not wait until somebody opens the port; what comes before is lost");
  serve.add_flag("--drop-framing-errors", request.settings.drop_framing_errors,
                 "leave out bytes without a stop bit");
  serve
      .add_option("--duration", request.settings.duration.value,
                  "end after 90s, 10min or 2h of the line's time; or at \"quit\", or a signal")
      ->type_name("TIME")
      ->transform(a_time());
  add_scenario_options(serve, request.options);
  serve.add_flag("--json", request.json, "one JSON object a line for each message on stdout");
  serve.footer(
      "Reads lines from stdin: KEY=VALUE as of --set changes the scenario from the next message "
      "on, quit ends. Example: cosys-sim serve scenarios/quickstart.toml --set receiver.range_m=1");
}

}  // namespace sim
