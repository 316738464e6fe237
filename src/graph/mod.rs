//! Scene and state to nodes and relations, with the feature layout. Learns nothing.
