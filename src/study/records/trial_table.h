#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "study/definition/conditions.h"
#include "study/records/data_folder.h"

namespace icome::study {

/// One number of each person in each condition, NaN where there is none. The study outlives it.
struct PersonTable {
  std::vector<const IndependentVariable*> within, between;
  std::vector<Crossing> columns;            // the levels of `within` in each
  std::vector<std::size_t> people;          // of StudyData::people, one a row
  std::vector<Crossing> groups;             // the levels of `between`, one a row
  std::vector<std::vector<double>> values;  // a row a person
};

/// Which of a person's measured trials count: all, or the last in each condition (thesis table 6.1).
enum class TrialChoice : std::uint8_t { All, Last };
enum class TrialSum : std::uint8_t { Mean, Total };

/// What SI values are multiplied with to be in the unit of a variable that is measured in trials.
struct MeasuredUnit {
  double scale = 1.0;
  std::string name;   // empty of counts
  bool known = true;  // otherwise the study's unit is none for such a quantity, and SI is taken
};
MeasuredUnit measured_unit(const DependentVariable& variable);

/// Whether trials measure the variable, rather than a questionnaire or nothing.
bool is_measured(const DependentVariable& variable);

/// The mean or total over measured trials of a variable that is_measured(), in its measured_unit(). Times are
/// of trials that were completed; distances and errors of all. There is none of a condition that a person has
/// not done to its end, as the trials that are there would be those with the least practice.
PersonTable measured_table(const StudyData& data, const DependentVariable& variable, TrialChoice choice,
                           TrialSum sum = TrialSum::Mean);

/// Where a question stands in its study.
struct ItemPlace {
  std::size_t questionnaire = 0, item = 0;
};
/// The question that a variable is from; false where it is from none.
bool find_item(const Study& study, const std::string& from, ItemPlace& place);

/// An answer that was given, with where it was.
struct GivenAnswer {
  std::size_t person = 0;     // of StudyData::people
  std::size_t condition = 0;  // of crossings(study, false); 0 where it is not asked after each
  std::string text;
};
/// The answers to a question, by people and then conditions, without empty ones.
std::vector<GivenAnswer> answers_to(const StudyData& data, const ItemPlace& place);

/// The numbers or points that people answered, without those that the question does not allow; with a column
/// a condition where it was asked after each.
PersonTable answered_table(const StudyData& data, const ItemPlace& place);

/// Only the people who have a number in every column.
PersonTable complete_rows(const PersonTable& table);
/// Only those people, by rows.
PersonTable rows_of(const PersonTable& table, const std::vector<std::size_t>& rows);
/// Only what belongs to one level of a factor, which is a factor of the table no more.
PersonTable at_level(const PersonTable& table, const IndependentVariable& factor, std::size_t level);

/// For each level of a factor of the table the means of its people over the columns that belong to it; for a
/// within factor in the order of the rows. Of a table with complete rows.
std::vector<std::vector<double>> by_level(const PersonTable& table, const IndependentVariable& factor);
/// Each person's mean over the columns.
std::vector<double> person_means(const PersonTable& table);

}  // namespace icome::study
