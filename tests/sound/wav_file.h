#pragma once
// Sound files for tests, by the definition of WAV.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace icome {

/// A WAV file of 16 bits; values of -1 to 1, interleaved.
inline void write_wav(const std::filesystem::path& file, int rate, int channels,
                      const std::vector<double>& values) {
  std::string bytes;
  const auto number = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += char(value >> (8 * i) & 0xffU);
  };
  const auto data = std::uint32_t(2 * values.size());
  bytes = "RIFF";
  number(36 + data, 4);
  bytes += "WAVEfmt ";
  number(16, 4);
  number(1, 2);
  number(std::uint32_t(channels), 2);
  number(std::uint32_t(rate), 4);
  number(std::uint32_t(2 * rate * channels), 4);
  number(std::uint32_t(2 * channels), 2);
  number(16, 2);
  bytes += "data";
  number(data, 4);
  for (const double value : values)
    number(std::uint32_t(std::uint16_t(std::int16_t(std::lround(32767 * value)))), 2);
  std::ofstream(file, std::ios::binary) << bytes;
}

/// A sine of some amplitude.
inline std::vector<double> sine(int rate, double frequency, double seconds, double amplitude) {
  std::vector<double> values(std::size_t(rate * seconds), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = amplitude * std::sin(2 * M_PI * frequency * double(i) / rate);
  return values;
}

}  // namespace icome
