//! Clients whose machine vanishes: from one moment on nothing reaches them and nothing leaves them, not even the end.

use std::{
    io,
    net::SocketAddr,
    sync::{Arc, Mutex},
};

use hyper_util::rt::TokioIo;
use socket2::{SockFilter, SockRef};
use tokio::net::TcpStream;
use tonic::transport::{Endpoint, Uri};
use tower::service_fn;

use crate::{keys::Bearer, server::TestChannel};

/// Takes every packet that comes for a socket away before the system sees it, acknowledgements included.
const DROP_ALL: SockFilter = SockFilter::new(0x06, 0, 0, 0);

/// The connections that will vanish.
#[derive(Clone, Default)]
pub struct Vanishing(Arc<Mutex<Vec<std::net::TcpStream>>>);

impl Vanishing {
    /// A connection that will.
    ///
    /// # Errors
    ///
    /// As the system says.
    pub async fn connect(&self, address: SocketAddr) -> io::Result<TcpStream> {
        let stream = TcpStream::connect(address).await?;
        stream.set_nodelay(true)?;
        let stream = stream.into_std()?;
        self.0.lock().unwrap().push(stream.try_clone()?);
        TcpStream::from_std(stream)
    }

    /// The same for gRPC.
    pub async fn channel(&self, address: SocketAddr) -> TestChannel {
        let vanishing = self.clone();
        let connect = service_fn(move |_: Uri| {
            let vanishing = vanishing.clone();
            async move { vanishing.connect(address).await.map(TokioIo::new) }
        });
        let channel = Endpoint::from_shared(format!("http://{address}"))
            .unwrap()
            .connect_with_connector(connect)
            .await
            .unwrap();
        TestChannel::new(channel, Bearer::default())
    }

    /// The link is down.
    pub fn vanish(&self) {
        for stream in self.0.lock().unwrap().iter() {
            SockRef::from(stream).attach_filter(&[DROP_ALL]).unwrap();
        }
    }
}
