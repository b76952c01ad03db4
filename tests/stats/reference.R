# SPDX-FileCopyrightText: 2026 The skin2afc authors
# SPDX-License-Identifier: MIT
#
# Writes the values that R gives for the figures of the analysis, to which the tests compare theirs:
#   Rscript reference.R > reference.tsv
# Columns: figure; its arguments, separated by spaces; its value. skin2afc itself needs no R.
suppressMessages(library(lme4))
cat(sprintf("# %s; lme4 %s\n", R.version.string, packageVersion("lme4")))
row <- function(figure, arguments, value) {
  cat(figure, paste(format(arguments, digits = 17, trim = TRUE, scientific = FALSE, drop0trailing = TRUE),
      collapse = " "), sprintf("%.17g", value), sep = "\t")
  cat("\n")
}

# One count of a sample: every k for small n, some of large ones.
count_figures <- function(k, n) {
  test <- suppressWarnings(chisq.test(c(k, n - k)))
  wilson <- suppressWarnings(prop.test(k, n, correct = FALSE)$conf.int)
  exact <- binom.test(k, n)
  row("chi_square", c(k, n), unname(test$statistic))
  row("p_chi_square", c(k, n), pchisq(unname(test$statistic), 1, lower.tail = FALSE))
  row("p_exact", c(k, n), exact$p.value)
  row("wilson_low", c(k, n), wilson[1])
  row("wilson_high", c(k, n), wilson[2])
  row("clopper_low", c(k, n), exact$conf.int[1])
  row("clopper_high", c(k, n), exact$conf.int[2])
  for (b in list(c(.35, .65), c(.4, .6))) {
    row("equivalence", c(k, n, b), max(pbinom(k - 1, n, b[1], lower.tail = FALSE), pbinom(k, n, b[2])))
  }
  row("log_bf01", c(k, n), n * log(.5) - lbeta(k + 1, n - k + 1))
}
for (n in c(1, 2, 3, 18, 32, 33, 72)) for (k in 0:n) count_figures(k, n)
for (k in c(0, 1, 30, 250, 499, 500, 501, 960, 999, 1000)) count_figures(k, 1000)
for (k in c(482000, 497000, 499000, 499999, 500000, 500100, 501500, 518000)) count_figures(k, 1e6)

# Corrections for many tests: number of values, index from 1, values.
for (p in list(c(.01, .02, .03, .04, .05), c(.9, .001, .02, .02, 1, 3e-12), c(.04, .04, .5))) {
  for (i in seq_along(p)) {
    row("holm", c(i, p), p.adjust(p, "holm")[i])
    row("bh", c(i, p), p.adjust(p, "BH")[i])
  }
}

# Participants: pairs k n.
pairs <- function(k, n) c(rbind(k, n))
flip <- function(k, n) {
  d <- 2 * k - n
  sums <- as.matrix(expand.grid(rep(list(c(-1, 1)), length(d)))) %*% d
  mean(abs(sums) >= abs(sum(d)))
}
samples <- list(list(c(17, 4, 15, 6, 18, 9, 16, 5, 14, 12), rep(18, 10)),
                list(c(1, 2, 2, 0, 1, 2, 2, 1, 2, 2, 1, 2, 0, 2, 2, 1), rep(2, 16)),
                list(c(12, 14, 13, 11, 16, 12, 15, 13, 12, 17, 14, 13), c(24, 24, 23, 24, 24, 22, 24, 24, 24, 24, 21, 24)),
                list(c(24, 23, 24, 22, 24, 24, 21, 24), rep(24, 8)),
                list(c(5, 19, 3, 20, 22, 1, 12, 23, 2, 11), rep(24, 10)))
for (s in samples) {
  k <- s[[1]]; n <- s[[2]]; id <- factor(seq_along(k))
  row("sign_flip", pairs(k, n), flip(k, n))
  row("t_test", pairs(k, n), t.test(k / n, mu = .5)$p.value)
  row("equivalence_t", pairs(k, n), max(t.test(k / n, mu = .35, alternative = "greater")$p.value,
                                        t.test(k / n, mu = .65, alternative = "less")$p.value))
  # The log-likelihood by R's own adaptive integration, its maximum by optim and its curvature by differences.
  loglik <- function(b, s) sum(mapply(function(k, n) log(integrate(function(u)
    exp(k * (b + s * u) - n * log1p(exp(b + s * u)) - k * b + n * log1p(exp(b))) * dnorm(u), -12, 12,
    rel.tol = 1e-11, subdivisions = 2000L)$value) + k * b - n * log1p(exp(b)), k, n))
  top <- optim(c(qlogis(sum(k) / sum(n)), .7), function(p) -loglik(p[1], p[2]), method = "BFGS",
               control = list(reltol = 1e-15, maxit = 500))
  null <- sum(k) * log(sum(k) / sum(n)) + sum(n - k) * log(1 - sum(k) / sum(n))
  ratio <- -2 * (top$value + null)
  row("log_likelihood", pairs(k, n), -top$value)
  row("heterogeneity", pairs(k, n), if (ratio < 1e-7) 1 else pchisq(ratio, 1, lower.tail = FALSE) / 2)
  model <- suppressMessages(glmer(cbind(k, n - k) ~ 1 + (1 | id), family = binomial, nAGQ = 25,
    control = glmerControl(optimizer = "Nelder_Mead", optCtrl = list(FtolRel = 1e-15, XtolRel = 1e-10, FtolAbs = 1e-12))))
  if (isSingular(model)) {
    model <- glm(cbind(k, n - k) ~ 1, family = binomial, control = list(epsilon = 1e-15))
    row("mixed_sd", pairs(k, n), 0)
    row("mixed_intercept", pairs(k, n), unname(coef(model)))
  } else {
    row("mixed_sd", pairs(k, n), unname(sqrt(VarCorr(model)$id[1])))
    row("mixed_intercept", pairs(k, n), unname(fixef(model)))
  }
  row("mixed_error", pairs(k, n), unname(sqrt(vcov(model)[1, 1])))
}

# Two groups: size of the first, values of both.
split_p <- function(a, b) {
  r <- rank(c(a, b)); m <- length(a)
  far <- function(w) abs(w - m * mean(r)) >= abs(sum(r[seq_along(a)]) - m * mean(r)) - 1e-9
  mean(far(combn(r, m, sum)))
}
for (g in list(list(c(3, 7, 9, 12, 14.5), c(1, 2, 4, 5, 6, 8, 10)), list(c(9, 7, 7, 5, 9, 12, 4), c(7, 5, 3, 3, 2, 9, 1, 0, 4)))) {
  a <- g[[1]]; b <- g[[2]]
  row("rank_sum_w", c(length(a), a, b), unname(suppressWarnings(wilcox.test(a, b)$statistic)))
  row("rank_sum_p", c(length(a), a, b), split_p(a, b))
  row("welch_p", c(length(a), a, b), t.test(a, b)$p.value)
}
stopifnot(abs(split_p(c(3, 7, 9, 12, 14.5), c(1, 2, 4, 5, 6, 8, 10)) -
              wilcox.test(c(3, 7, 9, 12, 14.5), c(1, 2, 4, 5, 6, 8, 10))$p.value) < 1e-12)
a <- round(1000 * sin(1:150)) %% 37; b <- round(1000 * cos(1:140)) %% 37 + 3
row("rank_sum_p", c(length(a), a, b), wilcox.test(a, b, exact = FALSE, correct = FALSE)$p.value)
for (q in c(0, .1, .25, .5, .75, 1)) row("quantile", c(q, 1, 2, 4, 8, 16, 32), unname(quantile(c(1, 2, 4, 8, 16, 32), q)))

# Order: chosen and answers where the reference was first, and where it was second.
for (o in list(c(28, 36, 20, 36), c(9, 16, 11, 16), c(10, 30, 25, 30))) {
  h <- qnorm(o[1] / o[2]); f <- qnorm(1 - o[3] / o[4])
  row("d_prime", o, sqrt(2) * qnorm((o[1] + o[3]) / (o[2] + o[4])))
  row("d_prime_order", o, (h - f) / sqrt(2))
  row("order_bias", o, -(h + f) / 2)
}

# Power of the exact test: trials, proportion, level; the last count without the power, plus one.
power <- function(n, p, level) {
  k <- 0:n
  sum(dbinom(k[sapply(k, function(k) binom.test(k, n)$p.value) <= level], n, p))
}
for (n in c(5, 6, 16, 32, 72, 200)) for (p in c(.5, .6, .7, .9)) for (level in c(.05, .001)) row("power", c(n, p, level), power(n, p, level))
for (p in c(.6, .65, .7, .75, .9)) {
  n <- 1:if (p == .6) 320 else 160
  row("trials_needed", c(p, .8, .05), max(n[sapply(n, power, p = p, level = .05) < .8]) + 1)
}
for (n in c(16, 32, 384)) row("detectable", c(n, .8, .05), uniroot(function(p) power(n, p, .05) - .8, c(.5, 1), tol = 1e-15)$root)
# The mean of the logistic of a normal variable.
for (s in c(.3, 1, 3)) row("median_logit", c(.65, s), uniroot(function(m) integrate(function(x)
  plogis(m + s * x) * dnorm(x), -30, 30, rel.tol = 1e-12, subdivisions = 2000L)$value - .65, c(0, 10), tol = 1e-14)$root)
