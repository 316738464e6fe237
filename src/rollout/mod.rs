//! The one loop: features, network, integration, new contacts. Shared by training and planning; chooses no actions.
