# What the benchmark of statistics is held against: Rscript stats_peer.R KIND FILE REPEATS reads and analyses
# the file, and prints "read", "compute" (median seconds) and "F TERM" lines. Base R only.
arguments <- commandArgs(TRUE)
kind <- arguments[1]
file <- arguments[2]
repeats <- as.integer(arguments[3])

print_f <- function(term, f) cat(sprintf("F %s %.17g\n", gsub(" ", "", term), f))

# The certified sets of NIST begin their data on line 61.
read <- function() {
  if (kind == "nist") {
    data <- read.table(file, skip = 60, col.names = c("g", "y"))
    data$g <- factor(data$g)
    data
  } else {
    read.csv(file, stringsAsFactors = TRUE)
  }
}

one_way <- function(data) c(g = summary(aov(y ~ g, data))[[1]][1, 4])

# Type II: each main effect after the other one.
factorial <- function(data) {
  full <- anova(lm(y ~ a * b, data))
  other <- anova(lm(y ~ b + a, data))
  ms <- full["Residuals", 3]
  c(a = other["a", 3] / ms, b = full["b", 3] / ms, "a:b" = full["a:b", 3] / ms)
}

# As textbooks on R have it: strata of error.
strata <- function(data) {
  tables <- summary(aov(y ~ a * b + Error(s / (a * b)), data))
  of <- function(stratum) tables[[paste("Error:", stratum)]][[1]][1, 4]
  c(a = of("s:a"), b = of("s:b"), "a:b" = of("s:a:b"))
}

# As people with many subjects do: a multivariate model of a column a condition. Rows are in that order.
wide <- function(data) {
  model <- lm(matrix(data$y, ncol = 12, byrow = TRUE) ~ 1)
  conditions <- data[1:12, c("a", "b")]
  of <- function(M, X) anova(model, M = M, X = X, idata = conditions, test = "Spherical")[1, "F"]
  c(a = of(~ a, ~ 1), b = of(~ b, ~ 1), "a:b" = of(~ a * b, ~ a + b))
}

analyse <- switch(kind, nist = one_way, one = one_way, two = factorial, strata = strata, wide = wide)
reading <- computing <- numeric(repeats)
for (i in seq_len(repeats)) {
  gc()
  reading[i] <- system.time(data <- read())[["elapsed"]]
  gc()
  computing[i] <- system.time(f <- analyse(data))[["elapsed"]]
}
cat(sprintf("read %.6f\ncompute %.6f\n", median(reading), median(computing)))
for (term in names(f)) print_f(term, f[[term]])
