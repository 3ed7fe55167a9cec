#pragma once

namespace icome::apps {

// The words of `icome study --help` that do not stand beside an option.

constexpr const char* kStudySummary =
    "User studies: write a study file, check it, run it with people or simulated ones, report";
constexpr const char* kStudyNewSummary = "Write a complete study file with comments, to be changed";
constexpr const char* kStudyCheckSummary =
    "Say what a study is: variables, groups, orders, how many people it takes; and what it lacks";
constexpr const char* kStudyRunSummary =
    "Take a person through a study in a window, or let simulated people take part";
constexpr const char* kStudyResumeSummary = "Go on with a person whose session was interrupted";
constexpr const char* kStudyReportSummary = "Analyse the data of a study: a page with tables and figures";

constexpr const char* kStudyExamples =
    "Examples:\n"
    "  icome study new pointing.toml               a small study with every part explained\n"
    "  icome study new menus.toml --template menu  the user experiment on menus of section 6.6 of the "
    "thesis\n"
    "  icome study check menus.toml                what it means, how many people, what is missing\n"
    "  icome study run pointing.toml --simulate 16 simulated people, to see what the data will be\n"
    "  icome study run pointing.toml --with age=31 the next person, in a window over the whole screen\n"
    "  icome study run pointing.toml --with age=31 --device haply  likewise, with a force-feedback device\n"
    "  icome study resume pointing.toml            the person whose session was interrupted goes on\n"
    "  icome study report pointing-data            tables, figures and tests as a page\n"
    "\n"
    "A study is one TOML file; docs/studies.md describes every key. All mistakes in it are told at once, "
    "with\n"
    "file, line and column.\n"
    "\n"
    "JSON of check: name, title, languages, hash (of what the file says), runnable, independent [{id, kind,\n"
    "  levels}], dependent [{id, type, unit, better, from}], control [{id, type, balanced}], hypotheses "
    "[{id,\n"
    "  dependent, factor, alpha, test, primary, and where it can be told effect, power, people_needed}], "
    "groups and\n"
    "  conditions [{factor: level}], order, orders (numbers of conditions, from 0, of the first people of a\n"
    "  group), order_count, participants, balanced_by, trials, session_seconds, reasons and warnings "
    "[{line,\n"
    "  column, sentence}], line 0 where they concern the whole.\n"
    "JSON of run --simulate: study, simulated, folder, participants.\n"
    "JSON of report: study, simulated, participants {people, complete, groups, control, trials}, tables "
    "[{factor,\n"
    "  trials, only, rows [{variable, unit, sum, levels, test, statistic, df, p, effect, outliers}]}], "
    "correlations,\n"
    "  hypotheses [{id, test, statistic, df, p, p_holm, effect, effect_ci, counts, doubts, primary, "
    "held_back,\n"
    "  beside, decision, conclusion, why}], questions, checks, warnings. p_holm decides (of a primary one it "
    "is p);\n"
    "  doubts are what speaks against it, conclusion the sentence of the report.\n"
    "\n"
    "Exit code: 0 done, 1 the study cannot be read or cannot be run as it is, 2 wrong usage, 3 a person "
    "ended\n"
    "before the end (resume goes on), 130 interrupted.";

}  // namespace icome::apps
