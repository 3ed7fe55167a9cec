#pragma once

namespace icome::apps {

// The words of `icome study --help` that do not stand beside an option.

constexpr const char* kStudySummary =
    "User studies: write a study file, learn what it means and what it lacks";
constexpr const char* kStudyNewSummary = "Write a complete study file with comments, to be changed";
constexpr const char* kStudyCheckSummary =
    "Say what a study is: variables, groups, orders, how many people it takes; and what it lacks";

constexpr const char* kStudyExamples =
    "Examples:\n"
    "  icome study new pointing.toml               a small study with every part explained\n"
    "  icome study new menus.toml --template menu  the user experiment on menus of section 6.6 of the "
    "thesis\n"
    "  icome study check menus.toml                what it means, how many people, what is missing\n"
    "\n"
    "A study is one TOML file; docs/studies.md describes every key. All mistakes in it are told at once, "
    "with\n"
    "file, line and column.\n"
    "\n"
    "JSON of check: name, title, languages, hash (of what the file says), runnable, independent [{id, kind,\n"
    "  levels}], dependent [{id, type, unit, better, from}], control [{id, type, balanced}], hypotheses "
    "[{id,\n"
    "  dependent, factor, alpha, test, and where it can be told effect, power, people_needed}], groups and\n"
    "  conditions [{factor: level}], order, orders (numbers of conditions, from 0, of the first people of a\n"
    "  group), order_count, participants, balanced_by, trials, session_seconds, reasons and warnings "
    "[{line,\n"
    "  column, sentence}], line 0 where they concern the whole.\n"
    "\n"
    "Exit code: 0 done, 1 the study cannot be read or cannot be run as it is, 2 wrong usage.";

}  // namespace icome::apps
