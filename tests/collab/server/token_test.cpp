#include "collab/server/token.h"

#include <set>

#include "collab/storage/sample_log.h"
#include "files/sample_files.h"
#include "memory_place.h"

namespace icome::collab {
namespace {

constexpr std::int64_t kNow = 1'700'000'000'000;
constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

class TokenTest : public testing::Test {
 protected:
  files::ScratchFolder folder_{memory_place()};
  TokenSigner signer_ = good(TokenSigner::open(folder_.path() / "token.key"));
  Invitation invitation_{
      .id = good(make_invitation_id()), .design = "dragon", .role = Role::Edit, .expires = kNow + 1};
  std::string token_ = good(signer_.sign(invitation_));

  std::string refusal(std::string_view token, std::string_view design = "dragon") const {
    return sentence_of(signer_.check(token, design, kNow));
  }
};

constexpr const char* kNotValid = "The link is not valid here, or not any more. Ask for a new one.";

TEST_F(TokenTest, SaysWhatWasSigned) {
  EXPECT_EQ(good(signer_.check(token_, "dragon", kNow)), invitation_);
  EXPECT_EQ(token_.size(), 52U);
  EXPECT_EQ(token_.find_first_not_of(kDigits), token_.npos);
  for (const Role role : {Role::View, Role::Edit, Role::Own}) {
    invitation_.role = role;
    EXPECT_EQ(good(signer_.check(good(signer_.sign(invitation_)), "dragon", kNow)).role, role);
  }
  EXPECT_EQ(role_name(Role::View), "view");
  EXPECT_EQ(role_name(Role::Own), "own");
}

TEST_F(TokenTest, RefusesAnotherCharacterAnywhere) {
  for (std::size_t i = 0; i < token_.size(); ++i) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string forged = token_;
      if (forged[i] == char(byte)) continue;
      forged[i] = char(byte);
      ASSERT_EQ(refusal(forged), kNotValid) << "character " << i << ", byte " << byte;
    }
  }
}

TEST_F(TokenTest, RefusesAnyOtherLength) {
  for (std::size_t length = 0; length < token_.size(); ++length)
    EXPECT_EQ(refusal(token_.substr(0, length)), kNotValid) << length;
  for (const char* more : {"A", "=", "==", "AAAA", "\n"}) EXPECT_EQ(refusal(token_ + more), kNotValid);
  EXPECT_EQ(refusal(token_ + token_), kNotValid);
  EXPECT_EQ(refusal(std::string(1'000'000, 'A')), kNotValid);
  EXPECT_EQ(refusal("none"), kNotValid);
}

TEST_F(TokenTest, IsForOneDesign) {
  for (const char* other : {"", "Dragon", "dragon ", "drago", "dragonfly"})
    EXPECT_EQ(refusal(token_, other), kNotValid);
  EXPECT_EQ(refusal(token_, std::string("dragon\0", 7)), kNotValid);
  EXPECT_EQ(refusal(token_, std::string(1'000'000, 'd')), kNotValid);
}

TEST_F(TokenTest, EndsAtItsTime) {
  EXPECT_TRUE(signer_.check(token_, "dragon", kNow));
  EXPECT_EQ(sentence_of(signer_.check(token_, "dragon", kNow + 1)),
            "The link has expired. Ask for a new one.");
  EXPECT_EQ(sentence_of(signer_.check(token_, "cat", kNow + 1)), kNotValid)
      << "only who has a genuine one is told";
}

TEST_F(TokenTest, SignsOnlyWhatFits) {
  const auto signs = [&](const std::string& id, std::int64_t expires) {
    return signer_.sign({.id = id, .design = "dragon", .role = Role::View, .expires = expires}).has_value();
  };
  const std::int64_t latest = (std::int64_t{1} << 48) - 1;
  EXPECT_TRUE(signs(invitation_.id, 0));
  EXPECT_TRUE(signs(invitation_.id, latest));
  EXPECT_FALSE(signs(invitation_.id, latest + 1));
  EXPECT_FALSE(signs(invitation_.id, -1));
  EXPECT_FALSE(signs("", kNow));
  EXPECT_FALSE(signs(invitation_.id.substr(1), kNow));
  EXPECT_FALSE(signs(invitation_.id + "0", kNow));
  EXPECT_FALSE(signs("x" + invitation_.id.substr(1), kNow));
  EXPECT_FALSE(signs("A" + invitation_.id.substr(1), kNow)) << "one way to write an id";
}

TEST_F(TokenTest, RefusesRolesThatThereAreNot) {
  for (unsigned role = 3; role < 16; ++role) {
    invitation_.role = Role(role);
    EXPECT_EQ(refusal(good(signer_.sign(invitation_))), kNotValid) << role;
  }
}

TEST_F(TokenTest, CountsInItsStoreOnly) {
  const TokenSigner other = good(TokenSigner::open(folder_.path() / "other.key"));
  EXPECT_EQ(sentence_of(other.check(token_, "dragon", kNow)), kNotValid);
  const TokenSigner again = good(TokenSigner::open(folder_.path() / "token.key"));
  EXPECT_TRUE(again.check(token_, "dragon", kNow));
}

TEST_F(TokenTest, KeepsItsKeySecret) {
  const auto key = folder_.path() / "token.key";
  EXPECT_EQ(std::filesystem::status(key).permissions(), std::filesystem::perms(0600));
  EXPECT_EQ(std::filesystem::file_size(key), 32U);
  for (const unsigned rights : {0640U, 0604U, 0620U, 0777U}) {
    std::filesystem::permissions(key, std::filesystem::perms(rights));
    EXPECT_NE(sentence_of(TokenSigner::open(key)).find("token.key: others may read this secret"),
              std::string::npos);
  }
}

TEST_F(TokenTest, TakesNoOtherFileForAKey) {
  const auto key = folder_.path() / "token.key";
  for (const std::size_t size : {0U, 31U, 33U, 100'000U}) {
    folder_.write("token.key", std::string(size, 'k'));
    EXPECT_NE(sentence_of(TokenSigner::open(key)).find("is not the key of a store"), std::string::npos);
  }
  EXPECT_FALSE(TokenSigner::open(folder_.path() / "missing" / "token.key"));
  EXPECT_FALSE(TokenSigner::open(folder_.path()));
}

TEST(InvitationId, IsNeverTheSame) {
  std::set<std::string> ids;
  for (int i = 0; i < 1000; ++i) ids.insert(good(make_invitation_id()));
  EXPECT_EQ(ids.size(), 1000U);
  EXPECT_EQ(ids.begin()->size(), 32U);
}

}  // namespace
}  // namespace icome::collab
