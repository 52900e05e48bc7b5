#pragma once
// stdout carries results, all of them or an error: a full disk behind a redirection is not silent.
// A reader that has seen enough, as `head` does, is no error of anybody: the program ends quietly,
// code 141. stderr carries words about results.
//
// Names that users give may hold what a terminal obeys. Text goes out without: of control
// characters (of ASCII, and C1 in UTF-8) only line feeds and tabs stay, for others a "?" stands.
#include <string_view>

#include "sim/failure.hpp"

namespace sim {

/// Why a write to stdout failed, by its errno.
Failure unwritable_output(int error);

/// Text for people and other programs. Throws unwritable_output().
void print(std::string_view text);
/// The same for JSON, in whose strings such characters are escaped and not lost.
void print_json(std::string_view text);
/// The same for bytes as they are.
void print_bytes(std::string_view bytes);

/// Nothing is lost if this cannot be written, so nobody is told.
void say(std::string_view text);
/// The same where it moves the cursor of a terminal, and names nothing that a user named.
void draw(std::string_view text);

/// Whether somebody looks at it: it is a terminal, no file and no pipe.
bool is_terminal();
/// How many characters a line of it has; 0 where that is not known, or it is no terminal.
int terminal_columns();

}  // namespace sim
