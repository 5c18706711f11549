//! Part of dalembert.
