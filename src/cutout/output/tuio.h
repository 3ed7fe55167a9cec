#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "cutout/tracker/tracker.h"
#include "io/host_port.h"

namespace icome::cutout {

/// Sightings as TUIO 1.1 (Kaltenbrunner et al. 2005): a bundle of OSC 1.0 with /tuio/2Dobj messages for
/// each frame, source, alive, set and fseq. The class is the place in the known list; a session lasts as long
/// as a triangle is seen. Places are shares of the table's width and height, angles radians, clockwise as
/// TUIO has them with y down; speeds in table widths a second and turns a second.
class TuioBundles {
 public:
  TuioBundles(double table_width, double table_height, std::string source);

  /// The bundles of a frame: more than one where one datagram cannot hold all.
  std::vector<std::string> of(const std::vector<Sighting>& sightings, double time);

 private:
  struct Object {
    std::int32_t session = 0;
    std::size_t triangle = 0;
    base::Vector2 place = base::Vector2::Zero();  // shares
    double angle = 0;                             // rad, clockwise, in [0, 2 pi)
    base::Vector2 speed = base::Vector2::Zero();  // shares/s
    double turn = 0;                              // turns/s
    double speed_up = 0, turn_up = 0;             // per s^2
  };
  Object moved(const Sighting& sighting, double seconds);

  double table_width_, table_height_;
  std::string source_;
  std::vector<Object> objects_;
  std::int32_t next_session_ = 1;
  std::int32_t frame_ = 0;
  double last_time_ = 0;
};

/// Sends datagrams to a host.
class UdpSender {
 public:
  /// Fails where the host has no address.
  static base::Result<UdpSender> create(const io::HostPort& place);
  UdpSender(UdpSender&& other) noexcept;
  ~UdpSender();

  /// Sends, or loses, the datagram; never waits.
  void send(const std::string& datagram);
  /// Datagrams that the system did not take.
  std::uint64_t lost() const { return lost_; }

 private:
  explicit UdpSender(int socket) : socket_(socket) {}

  int socket_ = -1;  // below zero once moved from
  std::uint64_t lost_ = 0;
};

}  // namespace icome::cutout
