# What anova_r_test.cpp compares with: Rscript anova_in_r.R FOLDER runs the calls of FOLDER/sets.R.
# Prints a key and its numbers a line.
options(contrasts = c("contr.sum", "contr.poly"), digits = 17)
folder <- commandArgs(TRUE)[1]

say <- function(key, ...) {
  cat(key, formatC(c(...), digits = 17, format = "g", width = 1), "\n")
}

read <- function(file) {
  data <- read.csv(file, na.strings = "NA", check.names = FALSE)
  for (name in setdiff(names(data), "y")) {
    # Levels as numbered: with empty cells, type III depends on which one is the last.
    present <- unique(data[[name]][!is.na(data[[name]])])
    data[[name]] <- factor(data[[name]], levels = present[order(as.integer(sub("l", "", present)))])
  }
  data
}

# Residual sum of squares and rank.
fitted_rss <- function(X, y) {
  q <- qr(X, tol = 1e-9)
  c(sum(qr.resid(q, y)^2), q$rank)
}

# Sums of squares by comparison of models under sum-to-zero contrasts.
between <- function(file, highest) {
  data <- droplevels(na.omit(read(file)))
  factors <- setdiff(names(data), "y")
  sums <- paste(factors, collapse = " + ")
  shape <- terms(as.formula(paste("~", if (highest == 1) sums else paste0("(", sums, ")^", highest))))
  X <- model.matrix(shape, data)
  in_term <- attr(shape, "factors") > 0
  columns_of <- function(terms) X[, attr(X, "assign") %in% terms, drop = FALSE]
  y <- data$y - mean(data$y)
  full <- fitted_rss(X, y)
  error_df <- nrow(data) - full[2]
  all_terms <- seq_len(ncol(in_term))
  for (type in 1:3) for (t in all_terms) {
    holds <- sapply(all_terms, function(other) all(in_term[, other] >= in_term[, t]))
    others <- c(0, switch(type, seq_len(t - 1), which(!holds), setdiff(all_terms, t)))
    without <- fitted_rss(columns_of(others), y)
    with <- fitted_rss(columns_of(c(others, t)), y)
    df <- with[2] - without[2]
    ss <- without[1] - with[1]
    f <- ss / df / (full[1] / error_df)
    say(paste(type, colnames(in_term)[t], sep = "/"), df, ss, f, pf(f, df, error_df, lower.tail = FALSE))
  }
  say("residual", error_df, full[1])
  if (length(factors) == 1) {
    welch <- oneway.test(data$y ~ data[[factors]])
    say("welch", welch$statistic, welch$parameter[2], welch$p.value)
  }
  say("described", mean(data$y), sd(data$y), quantile(data$y, c(.25, .5, .75)), t.test(data$y)$conf.int)
}

# aov with error strata on means of people who are in every cell, and Mauchly's test of the main effects.
within_subjects <- function(file, within, groups) {
  data <- droplevels(na.omit(read(file)))
  cells <- prod(sapply(data[within], nlevels))
  data <- aggregate(data["y"], data[c("s", within, groups)], mean)
  data <- droplevels(data[data$s %in% names(which(table(data$s) == cells)), ])
  data <- data[do.call(order, data[c("s", within)]), ]
  star <- function(names) paste(names, collapse = " * ")
  formula <- sprintf("y ~ %s + Error(s / (%s))", star(c(groups, within)), star(within))
  for (stratum in summary(aov(as.formula(formula), data))) {
    rows <- stratum[[1]]
    for (i in seq_len(nrow(rows) - 1)) {
      say(paste0("rm/", trimws(rownames(rows)[i])), unlist(rows[i, c(1, 2, 4, 5)]))
    }
  }
  Y <- matrix(data$y, ncol = cells, byrow = TRUE)
  people <- unique(data[c("s", groups)])
  for (name in within) if (nlevels(data[[name]]) > 2) {
    contrasts <- 1
    for (other in within) {
      k <- nlevels(data[[other]])
      helmert <- sweep(contr.helmert(k), 2, sqrt(colSums(contr.helmert(k)^2)), "/")
      contrasts <- kronecker(contrasts, if (other == name) helmert else matrix(1 / sqrt(k), k, 1))
    }
    people$Z <- Y %*% contrasts
    test <- mauchly.test(lm(as.formula(paste("Z ~", if (length(groups) > 0) star(groups) else "1")), people))
    say(paste0("mauchly/", name), test$statistic, test$p.value)
  }
}

source(file.path(folder, "sets.R"))
