#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "study/definition/conditions.h"
#include "study/records/data_folder.h"

namespace icome::study {

/// One number of each person in each condition, NaN where there is none. The study must outlive it.
struct PersonTable {
  std::vector<const IndependentVariable*> within, between;
  std::vector<Crossing> columns;            // the levels of `within` in each column
  std::vector<std::size_t> people;          // indices of StudyData::people, one a row
  std::vector<Crossing> groups;             // the levels of `between`, one a row
  std::vector<std::vector<double>> values;  // a row a person
};

/// The choice among a person's measured trials: all, or the last in each condition (thesis table 6.1).
enum class TrialChoice : std::uint8_t { All, Last };
enum class TrialSum : std::uint8_t { Mean, Total };

/// The unit of a variable that is measured in trials, with the factor from SI to it.
struct MeasuredUnit {
  double scale = 1.0;
  std::string name;   // for counts as the study gives it, or empty
  bool known = true;  // false: the study's unit does not fit the quantity, and SI is taken
};
MeasuredUnit measured_unit(const DependentVariable& variable);

/// Is the variable measured by trials, rather than by a questionnaire or not at all?
bool is_measured(const DependentVariable& variable);

/// The mean or total over measured trials of a variable that is_measured(), in its measured_unit(). Times are
/// of completed trials; distances and errors are of all. A condition that a person has not done to its end
/// has no value, as its trials would be those with the least practice.
PersonTable measured_table(const StudyData& data, const DependentVariable& variable, TrialChoice choice,
                           TrialSum sum = TrialSum::Mean);

/// Measured trials of all people, each an observation of its own; of people and conditions as
/// measured_table() has them.
struct TrialList {
  std::vector<std::vector<std::size_t>> levels;  // of each of Study::independent, one a trial
  std::vector<double> values;  // in the variable's measured_unit(), NaN for the time of one that has none
};
TrialList measured_trials(const StudyData& data, const DependentVariable& variable, TrialChoice choice);

/// The place of a question in its study.
struct ItemPlace {
  std::size_t questionnaire = 0, item = 0;
};
/// Finds the question that a variable is from. Returns false if it is from none.
bool find_item(const Study& study, const std::string& from, ItemPlace& place);

/// An answer that was given, with its person and condition.
struct GivenAnswer {
  std::size_t person = 0;     // of StudyData::people
  std::size_t condition = 0;  // of crossings(study, false); 0 if it is not asked after each condition
  std::string text;
};
/// The answers to a question, by people and then conditions, without empty ones.
std::vector<GivenAnswer> answers_to(const StudyData& data, const ItemPlace& place);

/// The numbers or points that people answered, NaN for those that the question does not allow; with a column
/// for each condition if it was asked after each.
PersonTable answered_table(const StudyData& data, const ItemPlace& place);

/// Keeps only the people who have a number in every column.
PersonTable complete_rows(const PersonTable& table);
/// Keeps only those people, by rows.
PersonTable rows_of(const PersonTable& table, const std::vector<std::size_t>& rows);
/// Keeps only the part that belongs to one level of a factor, which is no longer a factor of the table.
PersonTable at_level(const PersonTable& table, const IndependentVariable& factor, std::size_t level);

/// For each level of a factor of the table, the means of its people over the columns that belong to it; for
/// a within factor in the order of the rows. The rows of the table must be complete.
std::vector<std::vector<double>> by_level(const PersonTable& table, const IndependentVariable& factor);
/// Each person's mean over the columns.
std::vector<double> person_means(const PersonTable& table);

}  // namespace icome::study
