#include "collab/link/certificate.h"

#include <gtest/gtest.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "collab/link/link_bench.h"

namespace icome::collab {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Certificate, IsForThisComputerAndTenYears) {
  const CertificateFolder folder;
  std::FILE* const file = std::fopen(folder.certificate.c_str(), "r");
  ASSERT_NE(file, nullptr);
  X509* const certificate = PEM_read_X509(file, nullptr, nullptr, nullptr);
  std::fclose(file);
  ASSERT_NE(certificate, nullptr);
  EXPECT_EQ(X509_check_host(certificate, "localhost", 0, 0, nullptr), 1);
  EXPECT_EQ(X509_check_ip_asc(certificate, "127.0.0.1", 0), 1);
  EXPECT_EQ(X509_check_ip_asc(certificate, "::1", 0), 1);
  EXPECT_EQ(X509_check_host(certificate, "example.org", 0, 0, nullptr), 0);
  EXPECT_EQ(EVP_PKEY_get_bits(X509_get0_pubkey(certificate)), 256);
  EXPECT_EQ(X509_verify(certificate, X509_get0_pubkey(certificate)), 1);
  int days = 0;
  int seconds = 0;
  EXPECT_EQ(ASN1_TIME_diff(&days, &seconds, nullptr, X509_get0_notAfter(certificate)), 1);
  EXPECT_GE(days, 3650);
  X509_free(certificate);
}

TEST(Certificate, KeyIsForItsOwnerOnly) {
  const CertificateFolder folder;
  struct stat status = {};
  ASSERT_EQ(::stat(folder.key.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& it : std::filesystem::directory_iterator(folder.path)) ++files;
  EXPECT_EQ(files, 2U);
}

TEST(Certificate, FingerprintIsThatOfDer) {
  const CertificateFolder folder;
  EXPECT_EQ(folder.fingerprint.size(), 7U + 64U);
  EXPECT_EQ(folder.fingerprint.substr(0, 7), "sha256:");
  const CertificateFolder other;
  EXPECT_NE(folder.fingerprint, other.fingerprint);
}

TEST(Certificate, ExistingFilesStay) {
  const CertificateFolder folder;
  const std::string before = content_of(folder.certificate) + content_of(folder.key);
  const base::Result<void> again = make_certificate(folder.path / "new.pem", folder.key);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message.find("key.pem: is there already"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "new.pem"));
  EXPECT_FALSE(make_certificate(folder.certificate, folder.path / "new.key"));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "new.key"));
  EXPECT_EQ(content_of(folder.certificate) + content_of(folder.key), before);
}

TEST(Certificate, FilesThatHoldNoneAreNamed) {
  const CertificateFolder folder;
  const base::Result<std::string> of_key = fingerprint_of(folder.key);
  ASSERT_FALSE(of_key);
  EXPECT_NE(of_key.error().message.find("key.pem: holds no certificate"), std::string::npos);
  EXPECT_FALSE(fingerprint_of(folder.path / "none.pem"));
  const base::Result<void> nowhere =
      make_certificate(folder.path / "a" / "b.pem", folder.path / "a" / "b.key");
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().message.find("cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace icome::collab
