# A penalised additive model of ln(measured/law) over all columns at once (mgcv), fitted by REML.
# usage: Rscript rivals.R training.csv heldout.csv predicted.csv p_values.csv
# Columns but y and test are causes, best first: what the tests cannot carry is left out from behind.
suppressMessages(library(mgcv))
files <- commandArgs(TRUE)
training <- read.csv(files[1], stringsAsFactors = TRUE)
heldout <- read.csv(files[2], stringsAsFactors = TRUE)
causes <- setdiff(names(training), c("y", "test"))
grouped <- nrow(training) > nlevels(factor(training$test))
training$test <- factor(training$test)
tests <- nlevels(training$test)

for (name in causes) if (is.factor(training[[name]])) { # a level that training lacks has no effect
  every <- union(levels(training[[name]]), levels(factor(heldout[[name]])))
  training[[name]] <- factor(training[[name]], every)
  heldout[[name]] <- factor(heldout[[name]], every)
}

most <- if (tests < 8 * length(causes)) 4 else 6
is_factor <- sapply(training[causes], is.factor)
values <- sapply(training[causes], function(x) if (is.factor(x)) nlevels(x) else length(unique(x)))
knots <- pmin(most, values)
terms <- ifelse(is_factor, sprintf('s(%s, bs = "re")', causes),
                ifelse(values < 3, causes, sprintf("s(%s, k = %d)", causes, knots)))
coefficients <- ifelse(is_factor, values, knots - 1)
room <- nrow(training) - 2 - if (grouped) tests else 0
kept <- cumsum(coefficients) <= room
formula <- paste("y ~", paste(c(terms[kept], if (grouped) 's(test, bs = "re")'), collapse = " + "))
fit <- gam(as.formula(formula), data = training, method = "REML", select = TRUE,
           drop.unused.levels = FALSE)

heldout$test <- training$test[1]
predicted <- predict(fit, heldout, exclude = "s(test)")
write.csv(data.frame(y = as.numeric(predicted)), files[3], row.names = FALSE)
said <- summary(fit)
p <- c(setNames(said$s.table[, "p-value"], sub("^s\\((.*)\\)$", "\\1", rownames(said$s.table))), said$p.pv)
write.csv(data.frame(column = causes[kept], p = p[causes[kept]]), files[4], row.names = FALSE)
