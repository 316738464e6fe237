//! The networks: configuration, layers, physics predictor, weights; candle path and fused engine. Does not loop over time.
